// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/morphology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/raster.hpp"
#include "tests/library/form_town.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/footprints_text.hpp"
#include "tests/scenes/planted_crowns.hpp"

namespace farlod::library {
namespace {

using scenes::building;

CellAmounts amounts_together(const std::vector<CellMorphology>& cells) {
  CellAmounts sum;
  for (const CellMorphology& cell : cells) {
    const CellAmounts& a = cell.amounts;
    sum.plan_area_m2 += a.plan_area_m2;
    sum.building_plan_area_m2 += a.building_plan_area_m2;
    sum.roof_area_m2 += a.roof_area_m2;
    sum.wall_area_m2 += a.wall_area_m2;
    for (std::size_t k = 0; k < wind_directions; ++k) sum.frontal_area_m2[k] += a.frontal_area_m2[k];
    sum.volume_m3 += a.volume_m3;
    sum.height_moment_m4 += a.height_moment_m4;
    sum.height_max_m = std::max(sum.height_max_m, a.height_max_m);
    for (std::size_t k = 0; k < height_bins; ++k) sum.plan_area_by_height_m2[k] += a.plan_area_by_height_m2[k];
  }
  return sum;
}

TEST(Morphology, AHouseHasTheAreasOfItsSidesInCellsOfAnySize) {
  const FormTown town = form_house();
  for (const double cell_edge_m : {7.0, 13.0, 50.0, 200.0}) {
    SCOPED_TRACE(cell_edge_m);
    const CellAmounts sum = amounts_together(town.cells(cell_edge_m));
    EXPECT_NEAR(sum.building_plan_area_m2, 800.0, form_rounding_m2);
    EXPECT_NEAR(sum.roof_area_m2, 800.0, form_rounding_m2);
    EXPECT_NEAR(sum.wall_area_m2, 1200.0, form_rounding_m2);
    EXPECT_NEAR(sum.volume_m3, 8000.0, 10.0 * form_rounding_m2);
    EXPECT_NEAR(sum.height_moment_m4, 80000.0, 100.0 * form_rounding_m2);
    EXPECT_NEAR(sum.height_max_m, 10.0, form_rounding_m2);
  }
}

TEST(Morphology, WindMeetsTheSidesThatFaceIt) {
  const FormTown town = form_house();
  for (const AlignMode align : {AlignMode::none, AlignMode::automatic}) {
    const Package package = town.packed(50.0, align);
    const CellAmounts sum = amounts_together(morphology_of_cells(package));
    for (std::size_t k = 0; k < wind_directions; ++k) {
      // The map's own north lies this far from true north
      const double azimuth =
          2.0 * std::numbers::pi * static_cast<double>(k) / wind_directions - package.description().convergence.radians();
      EXPECT_NEAR(sum.frontal_area_m2[k], 400.0 * std::abs(std::cos(azimuth)) + 200.0 * std::abs(std::sin(azimuth)),
                  form_rounding_m2);
    }
  }
}

/// Two houses of the same length, 10 m and 6 m high, wall to wall along the y axis.
TEST(Morphology, PartyWallsAreNoWalls) {
  const FormTown town(
      scenes::FootprintsText().add(building("a", 10.0), form_box(0, 0, 10, 20)).add(building("b", 6.0), form_box(10, 0, 20, 20)));
  for (const double cell_edge_m : {5.0, 7.0, 50.0}) {
    SCOPED_TRACE(cell_edge_m);
    const CellAmounts sum = amounts_together(town.cells(cell_edge_m));
    EXPECT_NEAR(sum.wall_area_m2, 60.0 * 10.0 + 60.0 * 6.0 - 2.0 * 20.0 * 6.0, form_rounding_m2);
    EXPECT_NEAR(sum.building_plan_area_m2, 400.0, form_rounding_m2);
  }
}

/// A low house, and a higher one whose footprint overlaps it by 5 m × 20 m.
TEST(Morphology, WhatSeveralRoofsCoverCountsOnceAndAtTheHigherOne) {
  const FormTown town(
      scenes::FootprintsText().add(building("a", 10.0), form_box(0, 0, 10, 20)).add(building("b", 30.0), form_box(5, 0, 25, 20)));
  for (const double cell_edge_m : {7.0, 50.0}) {
    SCOPED_TRACE(cell_edge_m);
    const CellAmounts sum = amounts_together(town.cells(cell_edge_m));
    EXPECT_NEAR(sum.building_plan_area_m2, 500.0, form_rounding_m2);
    EXPECT_NEAR(sum.volume_m3, 100.0 * 10.0 + 400.0 * 30.0, 30.0 * form_rounding_m2);
    EXPECT_NEAR(sum.height_max_m, 30.0, form_rounding_m2);
  }
}

/// Houses of 4 m, 10 m and 80 m, one of them across cells: 10 m begins a bin, whatever rounding has made of it.
TEST(Morphology, HeightsGoToTheBinsOfModels) {
  const FormTown town(scenes::FootprintsText()
                          .add(building("a", 4.0), form_box(0, 0, 10, 10))
                          .add(building("b", 10.0), form_box(20, 0, 40, 10))
                          .add(building("c", 80.0), form_box(50, 0, 60, 20)));
  for (const double cell_edge_m : {13.0, 200.0}) {
    SCOPED_TRACE(cell_edge_m);
    UrbanForm together;
    together.amounts = amounts_together(town.cells(cell_edge_m));
    const auto& areas_m2 = together.amounts.plan_area_by_height_m2;
    for (const auto& [bin, area_m2] : {std::pair<std::size_t, double>(0, 100.0), {1, 0.0}, {2, 200.0}, {13, 0.0}, {14, 200.0}})
      EXPECT_NEAR(areas_m2.at(bin), area_m2, form_rounding_m2) << bin;
    EXPECT_NEAR(*together.height_share(2), 0.4, 1e-6);
  }
}

TEST(Morphology, TheSameHouseTwiceIsOne) {
  const FormTown town(
      scenes::FootprintsText().add(building("a", 10.0), form_box(0, 0, 10, 20)).add(building("b", 10.0), form_box(0, 0, 10, 20)));
  EXPECT_NEAR(amounts_together(town.cells(50.0)).building_plan_area_m2, 200.0, form_rounding_m2);
}

/// The middle cell of rows of houses of 10 m × 10 m and 10 m height, a house in the middle of each cell of 20 m.
TEST(Morphology, RatiosOfACellAreThoseOfThePublications) {
  CellMorphology cell;
  cell.amounts.plan_area_m2 = 400.0;
  cell.amounts.building_plan_area_m2 = cell.amounts.roof_area_m2 = 100.0;
  cell.amounts.wall_area_m2 = 400.0;
  cell.amounts.frontal_area_m2.fill(100.0);
  cell.amounts.volume_m3 = 1000.0;
  cell.amounts.height_moment_m4 = 10000.0;
  cell.amounts.height_max_m = 10.0;
  EXPECT_DOUBLE_EQ(cell.lambda_p(), 0.25);
  EXPECT_DOUBLE_EQ(cell.lambda_f(3), 0.25);
  EXPECT_DOUBLE_EQ(cell.lambda_f_mean(), 0.25);
  EXPECT_DOUBLE_EQ(cell.complete_aspect_ratio(), 2.0);
  EXPECT_DOUBLE_EQ(*cell.height_to_width(), 400.0 / 2.0 / 300.0);
  EXPECT_DOUBLE_EQ(*cell.height_mean_m(), 10.0);
  EXPECT_NEAR(*cell.height_std_m(), 0.0, 1e-6);
  // By hand: 4.43^-0.25 = 0.68928, so zd/H = 1 - 0.75 · 0.68928; z0/H = 0.51696 · exp(-(3.75 · 0.51696 · 0.25)^-0.5)
  EXPECT_NEAR(cell.roughness_macdonald()->displacement_m, 4.8304, 1e-3);
  EXPECT_NEAR(cell.roughness_macdonald()->length_m, 1.2292, 1e-3);
  // x = 1 and y = 0: zd = 1.29 · 0.25^0.36 · 10, z0 = 0.71 of the other
  EXPECT_NEAR(cell.roughness_kanda()->displacement_m, 7.8316, 1e-3);
  EXPECT_NEAR(cell.roughness_kanda()->length_m, 0.71 * cell.roughness_macdonald()->length_m, 1e-6);
}

/// Half of the plan area 10 m high, half 30 m.
TEST(Morphology, KandaKnowsHowHeightsDiffer) {
  CellMorphology cell;
  cell.amounts.plan_area_m2 = 1000.0;
  cell.amounts.building_plan_area_m2 = 400.0;
  cell.amounts.frontal_area_m2.fill(300.0);
  cell.amounts.volume_m3 = 200.0 * 10.0 + 200.0 * 30.0;
  cell.amounts.height_moment_m4 = 200.0 * 100.0 + 200.0 * 900.0;
  cell.amounts.height_max_m = 40.0;
  ASSERT_DOUBLE_EQ(*cell.height_std_m(), 10.0);
  // x = 0.75, y = 0.4 · 10 / 20
  EXPECT_NEAR(cell.roughness_kanda()->displacement_m, (-0.17 * 0.5625 + (1.29 * std::pow(0.4, 0.36) + 0.17) * 0.75) * 40.0, 1e-9);
  EXPECT_NEAR(cell.roughness_kanda()->length_m / cell.roughness_macdonald()->length_m, 20.21 * 0.04 - 0.77 * 0.2 + 0.71, 1e-9);
}

TEST(Morphology, ACellWithoutBuildingsHasNoHeights) {
  CellMorphology cell;
  cell.amounts.plan_area_m2 = 400.0;
  EXPECT_EQ(cell.lambda_p(), 0.0);
  EXPECT_EQ(cell.complete_aspect_ratio(), 1.0);
  EXPECT_EQ(cell.height_to_width(), 0.0);
  EXPECT_FALSE(cell.height_mean_m() || cell.height_std_m() || cell.height_share(0) || cell.roughness_macdonald() ||
               cell.roughness_kanda());
}

/// A low and a high house in the west and again in the east. The corner of four cells is in their middle.
TEST(Morphology, BuildingsOfACellCountOnceEach) {
  scenes::FootprintsText houses;
  for (const double east_m : {0.0, 150.0}) {
    houses.add(building("low", 10.0), form_box(east_m, 0, east_m + 30, 20));
    houses.add(building("high", 30.0), form_box(east_m + 40, 0, east_m + 50, 20));
  }
  std::size_t built = 0;
  for (const CellMorphology& cell : FormTown(houses).cells(500.0)) {
    if (cell.amounts.buildings == 0) continue;
    ++built;
    EXPECT_EQ(cell.amounts.buildings, 2U);
    EXPECT_NEAR(cell.amounts.building_height_mean_m, 20.0, form_rounding_m2);
    EXPECT_NEAR(cell.amounts.building_height_std_m, 10.0, form_rounding_m2);
    EXPECT_NEAR(*cell.height_mean_m(), (600.0 * 10.0 + 200.0 * 30.0) / 800.0, form_rounding_m2);
  }
  EXPECT_EQ(built, 4U);
}

/// Two upright cylinders of 5 m radius and 8 m height whose axes are 5 m apart, and a square of 4 m turned by 30°, 12 m high.
std::vector<CellMorphology> cells_with_crowns(double cell_edge_m) {
  const FormTown town = form_house();
  const auto folder = town.folder_of(cell_edge_m, AlignMode::none);
  CrownsOfCity crowns = scenes::crowns_for(folder);
  const auto [low, high] = crowns.grid().rectangle();
  // Wherever the cells lie; the ground is at 0
  const Point2d middle = 0.5 * (low + high);
  crowns.add(middle, 2.0, 8.0, 5.0, CrownShape::cylinder, Foliage::unknown);
  crowns.add(middle + Point2d{5.0, 0.0}, 2.0, 8.0, 5.0, CrownShape::cylinder, Foliage::unknown);
  crowns.add(middle - Point2d{13.0, 0.0}, 2.0, 12.0, 2.0, CrownShape::prism, Foliage::unknown, std::numbers::pi / 6.0);
  scenes::plant(crowns, folder);
  return morphology_of_cells(Package(folder));
}

TEST(Morphology, CrownsCoverTheirUnionInCellsOfAnySize) {
  constexpr double r = 5.0, d = 5.0;
  const double lens = 2.0 * r * r * std::acos(d / (2.0 * r)) - 0.5 * d * std::sqrt(4.0 * r * r - d * d);
  // At each end of a circle, lines 10 cm apart miss or add half a strip as long as the chord there, 2 · sqrt(2 · 5 m · 0.1 m);
  // at the corners of the square less
  constexpr double lines_m2 = 4 * 0.5 * 0.1 * 2.0;
  for (const double cell_edge_m : {7.0, 13.0, 50.0}) {
    SCOPED_TRACE(cell_edge_m);
    double area_m2 = 0.0, heights_m = 0.0;
    std::size_t count = 0;
    for (const CellMorphology& cell : cells_with_crowns(cell_edge_m)) {
      ASSERT_TRUE(cell.vegetation);
      area_m2 += *cell.vegetation_fraction() * cell.amounts.plan_area_m2;
      heights_m += cell.vegetation->height_mean_m * static_cast<double>(cell.vegetation->count);
      count += cell.vegetation->count;
    }
    EXPECT_NEAR(area_m2, 2.0 * std::numbers::pi * r * r - lens + 16.0, lines_m2);
    EXPECT_EQ(count, 3U);
    EXPECT_NEAR(heights_m, 8.0 + 8.0 + 12.0, 1e-3);
  }
}

TEST(Morphology, APackageWithoutTreesTellsNothingOfThem) {
  for (const CellMorphology& cell : form_house().cells(50.0)) EXPECT_FALSE(cell.vegetation || cell.vegetation_fraction());
}

/// As many values as columns, so that none stands below the name of another one.
TEST(Morphology, EachColumnHasItsValue) {
  CellMorphology cell;
  cell.amounts.plan_area_m2 = 400.0;
  cell.amounts.frontal_area_m2.back() = 100.0;
  cell.amounts.plan_area_by_height_m2[1] = 50.0;
  cell.amounts.plan_area_by_height_m2.back() = 150.0;
  cell.vegetation = CellVegetation{100.0, 3, 7.5};
  const auto columns = morphology_columns();
  const auto values = morphology_values(cell);
  ASSERT_EQ(columns.size(), values.size());
  const std::map<std::string_view, std::optional<double>> expected{
      {"area_m2", 400.0},           {"vegetation_fraction", 0.25}, {"lambda_f_337", 0.25},         {"crown_height_mean_m", 7.5},
      {"height_share_05_10", 0.25}, {"height_share_70", 0.75},     {"height_mean_m", std::nullopt}};
  std::size_t compared = 0;
  for (std::size_t n = 0; n < columns.size(); ++n) {
    const auto found = expected.find(columns[n].name);
    if (found == expected.end()) continue;
    EXPECT_EQ(values[n], found->second) << columns[n].name;
    ++compared;
  }
  EXPECT_EQ(compared, expected.size());
}

TEST(Morphology, IsTheSameForAnyNumberOfThreads) {
  const Package package(PackedSample::shared().folder());
  RunSettings one, many;
  one.threads = 1;
  many.threads = 4;
  const auto a = morphology_of_cells(package, one), b = morphology_of_cells(package, many);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(amounts_together(a).wall_area_m2, 0.0);
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].cell, b[n].cell);
    EXPECT_EQ(a[n].amounts.wall_area_m2, b[n].amounts.wall_area_m2);
    EXPECT_EQ(a[n].amounts.height_moment_m4, b[n].amounts.height_moment_m4);
    EXPECT_EQ(a[n].amounts.frontal_area_m2, b[n].amounts.frontal_area_m2);
  }
}

/// A house alone: its roof sees the whole sky, its walls see half of it, and the ground what a raster has there. The corner of
/// four cells is in its middle, so that all have the same.
TEST(Morphology, SkyOfCellsIsThatOfTheirReceivers) {
  constexpr double horizon_rounding = 2e-3;  // of 320 azimuths
  const FormTown town = form_house();
  const Package package = town.packed(100.0, AlignMode::none);
  const std::vector<CellSky> skies = sky_of_cells(package, 1.0);
  ASSERT_EQ(skies.size(), morphology_of_cells(package).size());
  const Raster raster = evaluate_raster(package, plan_raster(package, 1.0, package.description().outline_projected),
                                        {.above = HeightAbove::ground, .height_m = 0.0});
  double sum = 0.0, count = 0.0;
  std::size_t built = 0;
  for (const CellSky& sky : skies) {
    if (sky.ground) sum += *sky.ground, count += 1.0;
    if (!sky.walls) continue;
    ++built;
    EXPECT_NEAR(*sky.walls, 0.5, horizon_rounding);
    EXPECT_NEAR(*sky.roofs, 1.0, horizon_rounding);
    EXPECT_LT(*sky.ground, 0.999);
  }
  EXPECT_EQ(built, 4U);
  EXPECT_NEAR(sum / count, *raster.summary.svf_mean, horizon_rounding);
}

TEST(Morphology, SkyOfCellsRefusesWhatMakesNoSense) {
  const FormTown town = form_house();
  const Package package = town.packed(100.0, AlignMode::none);
  EvaluationSettings dry;
  dry.dry_run = true;
  EXPECT_THROW((void)sky_of_cells(package, 0.0), InvalidArgument);
  EXPECT_THROW((void)sky_of_cells(package, 2.0, dry), InvalidArgument);
}

TEST(Morphology, NeedsBuildingsThatAreCutAtTheBorders) {
  const FormTown town = form_house();
  EXPECT_THROW((void)morphology_of_cells(town.packed(13.0, AlignMode::none, Assign::whole)), InvalidArgument);
}

}  // namespace
}  // namespace farlod::library
