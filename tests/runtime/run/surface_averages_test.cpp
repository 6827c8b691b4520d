// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/surface_averages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "run/facing.hpp"

namespace farlod {
namespace {

SurfacePoint receiver(const char* building, std::uint32_t surface, SurfaceKind kind, double area_m2, std::optional<double> svf) {
  SurfacePoint row;
  row.building = building;
  row.surface = surface;
  row.kind = kind;
  row.area_m2 = area_m2;
  row.svf = svf;
  return row;
}

/// A run of two cells: a wall of house b lies in both. Areas and answers are small multiples of powers of two: sums are exact.
std::vector<std::pair<PlaceInRun, SurfacePoint>> small_run() {
  return {{{0, 0}, receiver("b", 7, SurfaceKind::wall, 2.0, 0.5)},
          {{0, 1}, receiver("a", 1, SurfaceKind::roof, 4.0, {})},
          {{3, 0}, receiver("b", 7, SurfaceKind::wall, 6.0, 0.25)},
          {{3, 1}, receiver("b", 8, SurfaceKind::roof, 1.0, 1.0)}};
}

template <class Averages>
auto rows_of(const std::vector<std::pair<PlaceInRun, SurfacePoint>>& run) {
  Averages averages;
  for (const auto& [place, row] : run) averages.add(place, row);
  return averages.rows();
}

TEST(SurfaceAverages, AreWeightedByArea) {
  const auto rows = rows_of<SurfaceAverages>(small_run());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].surface, 7U);
  EXPECT_EQ(rows[0].area_m2, 8.0);
  EXPECT_EQ(rows[0].receivers, 2U);
  EXPECT_EQ(rows[0].svf_mean, (2.0 * 0.5 + 6.0 * 0.25) / 8.0);
  EXPECT_EQ(rows[0].svf_min, 0.25);
  EXPECT_EQ(rows[0].svf_max, 0.5);
}

TEST(SurfaceAverages, KeepTheRowOfASurfaceWithoutAnAnswer) {
  const auto rows = rows_of<SurfaceAverages>(small_run());
  EXPECT_EQ(rows[1].building, "a");
  EXPECT_EQ(rows[1].nodata, 1U);
  EXPECT_EQ(rows[1].covered_area_m2, 4.0);
  EXPECT_EQ(rows[1].area_m2, 0.0);
  EXPECT_EQ(rows[0].covered_area_m2, 0.0);
  EXPECT_FALSE(rows[1].svf_mean || rows[1].svf_min || rows[1].svf_max);
}

TEST(SurfaceAverages, StandInTheOrderOfTheRunHoweverTheyCome) {
  auto run = small_run();
  const auto expected = rows_of<SurfaceAverages>(run);
  std::reverse(run.begin(), run.end());
  const auto rows = rows_of<SurfaceAverages>(run);
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    EXPECT_EQ(rows[n].building, expected[n].building);
    EXPECT_EQ(rows[n].surface, expected[n].surface);
    EXPECT_EQ(rows[n].svf_mean, expected[n].svf_mean);
  }
}

TEST(BuildingAverages, TellRoofsFromWalls) {
  auto run = small_run();
  std::reverse(run.begin(), run.end());
  const auto rows = rows_of<BuildingAverages>(run);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].building, "b");
  EXPECT_EQ(rows[0].wall_area_m2, 8.0);
  EXPECT_EQ(rows[0].roof_area_m2, 1.0);
  EXPECT_EQ(rows[0].svf_walls, 0.3125);
  EXPECT_EQ(rows[0].svf_roofs, 1.0);
  EXPECT_EQ(rows[1].covered_roof_area_m2, 4.0);
  EXPECT_EQ(rows[1].covered_wall_area_m2, 0.0);
  EXPECT_EQ(rows[1].building, "a");
  EXPECT_FALSE(rows[1].svf_roofs || rows[1].svf_walls);
}

/// The same run with a second value, and the irradiation in kWh/m² behind it: half of the wall and the roof of b get 800.
std::vector<std::pair<PlaceInRun, SurfacePoint>> irradiated_run() {
  auto run = small_run();
  run[0].second.further = {0.5F, 800.0F};
  run[2].second.further = {std::nanf(""), 400.0F};
  run[3].second.further = {0.25F, 1200.0F};
  return run;
}

template <class Averages>
auto irradiated_rows(const WantedIrradiation& wanted) {
  Averages averages(wanted);
  for (const auto& [place, row] : irradiated_run()) averages.add(place, row);
  return averages.rows();
}

TEST(SurfaceAverages, SumIrradiationOverTheArea) {
  const auto rows = irradiated_rows<SurfaceAverages>({1, 800.0});
  ASSERT_TRUE(rows[0].irradiation);
  EXPECT_EQ(rows[0].irradiation->kwh, 2.0 * 800.0 + 6.0 * 400.0);
  EXPECT_EQ(rows[0].irradiation->area_above_m2, 2.0);
  EXPECT_EQ(rows[0].further_mean, (std::vector{0.5, (2.0 * 800.0 + 6.0 * 400.0) / 8.0}));
  EXPECT_FALSE(rows[1].irradiation) << "no receiver of this roof has an answer";
}

TEST(SurfaceAverages, ThatGetLessThanTheThresholdHaveNoAreaAboveIt) {
  const auto rows = irradiated_rows<SurfaceAverages>({1, 1200.5});
  for (const SurfaceMean& row : rows)
    if (row.irradiation) {
      EXPECT_EQ(row.irradiation->area_above_m2, 0.0);
    }
}

TEST(SurfaceAverages, KnowNothingOfIrradiationThatNobodyAskedFor) {
  EXPECT_FALSE(irradiated_rows<SurfaceAverages>({}).front().irradiation);
  const auto rows = irradiated_rows<SurfaceAverages>({1, {}});
  ASSERT_TRUE(rows[0].irradiation);
  EXPECT_FALSE(rows[0].irradiation->area_above_m2);
}

TEST(BuildingAverages, TellTheIrradiationOfRoofsFromThatOfWalls) {
  const auto rows = irradiated_rows<BuildingAverages>({1, 800.0});
  ASSERT_TRUE(rows[0].roof_irradiation && rows[0].wall_irradiation);
  EXPECT_EQ(rows[0].roof_irradiation->kwh, 1200.0);
  EXPECT_EQ(rows[0].roof_irradiation->area_above_m2, 1.0);
  EXPECT_EQ(rows[0].wall_irradiation->kwh, 2.0 * 800.0 + 6.0 * 400.0);
  EXPECT_EQ(rows[0].wall_irradiation->area_above_m2, 2.0);
  EXPECT_EQ(rows[0].further_roofs, (std::vector{0.25, 1200.0}));
  EXPECT_EQ(rows[0].further_walls, (std::vector{0.5, 500.0}));
  EXPECT_FALSE(rows[1].roof_irradiation || rows[1].wall_irradiation);
  EXPECT_TRUE(rows[1].further_roofs.empty() && rows[1].further_walls.empty());
}

/// Of a few products and sums of numbers up to 1, and of degrees up to 360.
constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
constexpr double rounding_deg = 360.0 * rounding;

package::Manifest turned_grid() {
  package::Manifest m;
  m.grid.rotation = GridRotation(Angle::degrees(28.3));
  m.convergence = Angle::degrees(0.673);
  return m;
}

TEST(Facing, ComesBackFromItsNormal) {
  const package::Manifest m = turned_grid();
  for (const double azimuth_deg : {0.0, 1.0, 89.5, 180.0, 270.0, 359.0})
    for (const double tilt_deg : {0.5, 45.0, 90.0, 135.0, 179.0}) {
      const Facing facing = facing_of(normal_of({Angle::degrees(azimuth_deg), Angle::degrees(tilt_deg)}, m), m);
      // The sine of half a degree divides the rounding of the normal
      EXPECT_NEAR(std::remainder(facing.azimuth.degrees() - azimuth_deg, 360.0), 0.0, rounding_deg / sin(Angle::degrees(0.5)));
      EXPECT_NEAR(facing.tilt.degrees(), tilt_deg, rounding_deg / sin(Angle::degrees(0.5)));
    }
}

TEST(Facing, OfAWallAlongTheGridIsItsBearingFromTrueNorth) {
  const package::Manifest m = turned_grid();
  EXPECT_NEAR(facing_of({0.0, 1.0, 0.0}, m).azimuth.degrees(), 28.3 + 0.673, rounding_deg);
  EXPECT_NEAR(facing_of({1.0, 0.0, 0.0}, m).azimuth.degrees(), 28.3 + 0.673 + 90.0, rounding_deg);
}

TEST(Facing, WithoutTiltIsStraightUp) {
  const package::Manifest m = turned_grid();
  for (const double azimuth_deg : {0.0, 77.0})
    EXPECT_EQ(normal_of({Angle::degrees(azimuth_deg), {}}, m), (Point3d{0.0, 0.0, 1.0}));
  EXPECT_EQ(facing_of({0.0, 0.0, 1.0}, m).azimuth, Angle{});
}

}  // namespace
}  // namespace farlod
