// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/surface_averages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace farlod
