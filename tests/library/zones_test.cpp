// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/morphology.hpp"
#include "farlod/region.hpp"
#include "tests/library/form_town.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/footprints_text.hpp"
#include "tests/scenes/planted_crowns.hpp"

namespace farlod::library {
namespace {

using scenes::building;

std::vector<Point2d> form_ring(const std::vector<Point2d>& corners) {
  std::vector<Point2d> ring;
  for (const Point2d p : corners) ring.push_back(form_corner + p);
  return ring;
}

/// A square around the house without a triangle that cuts it askew, and the triangle.
std::vector<Zone> form_partition() {
  const std::vector<Point2d> around = form_ring({{-60, -50}, {90, -50}, {90, 70}, {-60, 70}});
  const std::vector<Point2d> triangle = form_ring({{-7, -11}, {31, 3}, {12, 33}});
  return {{around, triangle}, {triangle}};
}

std::vector<double> sums_of(const std::vector<UrbanForm>& forms) {
  std::vector<double> sums(wind_directions + 5);
  for (const UrbanForm& form : forms) {
    const CellAmounts& a = form.amounts;
    for (std::size_t k = 0; k < wind_directions; ++k) sums[k] += a.frontal_area_m2[k];
    sums[wind_directions] += a.building_plan_area_m2;
    sums[wind_directions + 1] += a.roof_area_m2;
    sums[wind_directions + 2] += a.wall_area_m2;
    sums[wind_directions + 3] += a.volume_m3;
    sums[wind_directions + 4] += a.height_moment_m4;
  }
  return sums;
}

/// Two houses wall to wall, a gap, and a third one, in cells of any size and turn: what zones have together is the city's.
TEST(Zones, ZonesThatPartTheCityHaveTheSumsOfTheCity) {
  const FormTown town(
      scenes::FootprintsText()
          .add(building("a", 10.0), form_box(0, 0, 10, 20))
          .add(building("b", 6.0), form_box(10, 0, 20, 20))
          .add(building("c", 17.0), {form_corner + Point2d{25, 2}, form_corner + Point2d{41, 9}, form_corner + Point2d{30, 21}}));
  for (const double cell_edge_m : {7.0, 13.0, 100.0})
    for (const AlignMode align : {AlignMode::none, AlignMode::automatic}) {
      SCOPED_TRACE(cell_edge_m);
      const Package package = town.packed(cell_edge_m, align);
      const auto cells = morphology_of_cells(package);
      const auto zones = morphology_of_zones(package, form_partition());
      EXPECT_GT(zones[1].amounts.wall_area_m2, 100.0);
      const auto expected = sums_of({cells.begin(), cells.end()}), found = sums_of(zones);
      for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_NEAR(found[n], expected[n], 1e-6 * expected[n] + form_rounding_m2);
    }
}

TEST(Zones, AZoneHasWhatLiesInIt) {
  const FormTown town = form_house();
  for (const double cell_edge_m : {7.0, 100.0}) {
    const auto forms = morphology_of_zones(town.packed(cell_edge_m, AlignMode::none),
                                           {{form_ring({{-10, -20}, {10, -20}, {10, 30}, {-10, 30}})}});
    ASSERT_EQ(forms.size(), 1U);
    const CellAmounts& a = forms[0].amounts;
    EXPECT_NEAR(a.plan_area_m2, 1000.0, form_rounding_m2);
    EXPECT_NEAR(a.building_plan_area_m2, 200.0, form_rounding_m2);
    EXPECT_NEAR(a.wall_area_m2, 10.0 * (10.0 + 20.0 + 10.0), form_rounding_m2);
    EXPECT_NEAR(a.volume_m3, 2000.0, 10.0 * form_rounding_m2);
    EXPECT_EQ(a.buildings, 1U);
    EXPECT_NEAR(a.building_height_mean_m, 10.0, form_rounding_m2);
    EXPECT_NEAR(a.height_max_m, 10.0, form_rounding_m2);
  }
}

/// Zones that part along the house's walls, where borders of cells may lie, too.
TEST(Zones, AWallOnABorderBelongsToTheZoneOfItsBuilding) {
  const FormTown town = form_house();
  const std::vector<Zone> zones{{form_ring({{0, 0}, {40, 0}, {40, 20}, {0, 20}})},
                                {form_ring({{-50, -50}, {0, -50}, {0, 70}, {-50, 70}})},
                                {form_ring({{0, -50}, {40, -50}, {40, 0}, {0, 0}})}};
  for (const double cell_edge_m : {10.0, 20.0, 37.0}) {
    const auto forms = morphology_of_zones(town.packed(cell_edge_m, AlignMode::none), zones);
    EXPECT_NEAR(forms[0].amounts.wall_area_m2, 1200.0, form_rounding_m2);
    EXPECT_NEAR(forms[1].amounts.wall_area_m2, 0.0, form_rounding_m2);
    EXPECT_NEAR(forms[2].amounts.wall_area_m2, 0.0, form_rounding_m2);
  }
}

/// The squares of all cells.
std::vector<Zone> squares_of(const std::vector<CellMorphology>& cells) {
  std::vector<Zone> zones;
  for (const CellMorphology& cell : cells) zones.push_back({{cell.corners_projected.begin(), cell.corners_projected.end()}});
  return zones;
}

TEST(Zones, SkyOfSquaresIsThatOfTheirCells) {
  const Package package(PackedSample::shared().folder());
  const auto of_cells = sky_of_cells(package, 4.0),
             of_zones = sky_of_zones(package, squares_of(morphology_of_cells(package)), 4.0);
  ASSERT_EQ(of_zones.size(), of_cells.size());
  std::size_t built = 0;
  for (std::size_t n = 0; n < of_cells.size(); ++n) {
    ASSERT_EQ(of_zones[n].ground.has_value(), of_cells[n].ground.has_value());
    if (of_cells[n].ground) EXPECT_NEAR(*of_zones[n].ground, *of_cells[n].ground, 1e-4);
    if (!of_cells[n].walls || !of_cells[n].roofs) continue;
    ++built;
    EXPECT_NEAR(of_zones[n].walls.value(), *of_cells[n].walls, 2e-3) << "borders cut walls, whose places may be of either side";
    EXPECT_NEAR(of_zones[n].roofs.value(), *of_cells[n].roofs, 2e-3);
  }
  EXPECT_GT(built, 3U);
}

/// A house, and the ground around it: zones that part along its walls.
TEST(Zones, SkyOfAWallIsThatOfTheZoneOfItsBuilding) {
  const FormTown town = form_house();
  const Package package = town.packed(37.0, AlignMode::none);
  const auto sky = sky_of_zones(package,
                                {{form_ring({{0, 0}, {40, 0}, {40, 20}, {0, 20}})},
                                 {form_ring({{-15, -15}, {0, -15}, {0, 35}, {-15, 35}})},
                                 {form_ring({{500, 500}, {510, 500}, {510, 510}})}},
                                1.0);
  ASSERT_EQ(sky.size(), 3U);
  EXPECT_FALSE(sky[0].ground);
  EXPECT_NEAR(sky[0].walls.value(), 0.5, 2e-3);
  EXPECT_NEAR(sky[0].roofs.value(), 1.0, 2e-3);
  EXPECT_FALSE(sky[1].walls || sky[1].roofs);
  EXPECT_GT(sky[1].ground.value(), 0.5);
  EXPECT_LT(sky[1].ground.value(), 0.95);
  EXPECT_FALSE(sky[2].ground || sky[2].walls || sky[2].roofs) << "beyond the grid";
}

TEST(Zones, SkyOfZonesRefusesWhatMakesNoSense) {
  const FormTown town = form_house();
  const Package package = town.packed(50.0, AlignMode::none);
  EvaluationSettings of_region;
  of_region.region = std::make_shared<const Region>(std::vector<Region::Ring>{});
  EXPECT_TRUE(sky_of_zones(package, {}, 2.0).empty());
  EXPECT_THROW((void)sky_of_zones(package, {}, 0.0), InvalidArgument);
  EXPECT_THROW((void)sky_of_zones(package, {}, 2.0, of_region), InvalidArgument);
}

TEST(Zones, BeyondTheGridNothingIsKnown) {
  const FormTown town = form_house();
  const Package package = town.packed(50.0, AlignMode::none);
  const Zone beyond{form_ring({{5000, 5000}, {5100, 5000}, {5100, 5100}})}, here{form_ring({{-10, -20}, {10, -20}, {10, 30}})};
  const auto forms = morphology_of_zones(package, {here, beyond});
  EXPECT_GT(forms[0].amounts.plan_area_m2, 0.0);
  EXPECT_EQ(forms[1].amounts.plan_area_m2, 0.0);
  EXPECT_TRUE(morphology_values(forms[0]).front().has_value());
  const auto values = morphology_values(forms[1]);
  EXPECT_EQ(values.size(), morphology_columns().size());
  EXPECT_TRUE(std::ranges::none_of(values, [](const auto& value) { return value.has_value(); }));
  EXPECT_THROW((void)morphology_of_zones(package, {beyond}), InvalidArgument);
}

TEST(Zones, ZonesWithoutAreaAreRefused) {
  const FormTown town = form_house();
  const Package package = town.packed(50.0, AlignMode::none);
  EXPECT_TRUE(morphology_of_zones(package, {}).empty());
  EXPECT_THROW((void)morphology_of_zones(package, {Zone{}}), InvalidArgument);
  EXPECT_THROW((void)morphology_of_zones(package, {{{{0, 0}, {1e9, 0}, {0, 1e9}}}}), InvalidArgument);
}

/// A crown on the border of the two zones of the partition, and one in the triangle.
TEST(Zones, CrownsArePartedLikeTheGround) {
  const FormTown town = form_house();
  const auto folder = town.folder_of(13.0, AlignMode::none);
  CrownsOfCity crowns = scenes::crowns_for(folder);
  const auto [low, high] = crowns.grid().rectangle();
  const Point2d middle = 0.5 * (low + high);  // of the house, which lies 20 m and 10 m from its corner
  crowns.add(middle - Point2d{16.0, 2.0}, 2.0, 8.0, 5.0, CrownShape::cylinder, Foliage::unknown);
  crowns.add(middle - Point2d{6.0, 0.0}, 2.0, 12.0, 2.0, CrownShape::spheroid, Foliage::unknown);
  scenes::plant(crowns, folder);
  const Package package(folder);
  double in_cells_m2 = 0.0, in_zones_m2 = 0.0;
  for (const CellMorphology& cell : morphology_of_cells(package)) in_cells_m2 += cell.vegetation->plan_area_m2;
  const auto zones = morphology_of_zones(package, form_partition());
  for (const UrbanForm& zone : zones) in_zones_m2 += zone.vegetation->plan_area_m2;
  EXPECT_GT(in_cells_m2, 85.0);
  // Lines are parted where the border is
  EXPECT_NEAR(in_zones_m2, in_cells_m2, form_rounding_m2);
  EXPECT_GT(zones[0].vegetation->plan_area_m2, 5.0);
  EXPECT_EQ(zones[0].vegetation->count + zones[1].vegetation->count, 2U);
  EXPECT_GE(zones[1].vegetation->count, 1U);
}

}  // namespace
}  // namespace farlod::library
