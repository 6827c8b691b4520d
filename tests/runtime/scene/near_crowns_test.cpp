// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/canopy_around.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

/// Cells of 20 m, 8 × 6 of them, with some crowns in every other one.
class Park : public testing::Test {
 protected:
  Park() {
    scenes::SceneBuilder builder;
    builder.add_box({{1.0, 1.0}, {4.0, 4.0}}, 0.0, 3.0);
    builder.add_box({{150.0, 110.0}, {155.0, 115.0}}, 0.0, 3.0);
    const Grid grid = scenes::grid_covering(builder.city(), {}, 20.0, 1, 4);
    scenes::pack_city(builder.city(), grid, folder, scenes::box_maps(4, 4), Assign::clip, std::vector<Cell>{});
    CrownsOfCity crowns = scenes::crowns_for(folder);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> x_m(0.0, 160.0), y_m(0.0, 120.0), half_width_m(0.5, 6.0);
    for (std::size_t n = 0; n < 600; ++n) {
      const Point2d p{x_m(random), y_m(random)};
      if ((grid.cell_of(p).i + grid.cell_of(p).j) % 2 == 0) continue;
      crowns.add(p, 2.0, 9.0, half_width_m(random), static_cast<CrownShape>(n % 3), Foliage::unknown, 0.3);
    }
    scenes::plant(crowns, folder);
  }

  scenes::TemporaryFolder temporary;
  std::filesystem::path folder = temporary.path() / "park.farlod";
};

/// How far a crown lies from the square of its frame's cell; a prism counts as the circle around it.
double distance_m(const Crown& c, double edge_m) {
  const double x_m = c.x_m - std::clamp<double>(c.x_m, 0.0, edge_m), y_m = c.y_m - std::clamp<double>(c.y_m, 0.0, edge_m);
  return std::hypot(x_m, y_m) - c.half_width_m * (c.shape == CrownShape::prism ? std::numbers::sqrt2 : 1.0);
}

TEST_F(Park, NearCrownsAreThoseOfTheCityThatReachTheCell) {
  const PackageReader package(folder);
  const double edge_m = package.grid().cell_edge_m;
  const auto crown_count = static_cast<std::size_t>(package.manifest().canopy->crowns());
  ASSERT_GT(crown_count, 200U);
  for (const Cell cell : {Cell{0, 0}, Cell{3, 2}, Cell{7, 5}, Cell{0, 5}})
    for (const double distance : {0.0, 1.0, 19.0, 45.0, 1e9}) {
      std::vector<Crown> expected = crowns_of_whole_city(package, cell);
      ASSERT_EQ(expected.size(), crown_count);
      std::erase_if(expected, [&](const Crown& c) { return distance_m(c, edge_m) > distance; });
      EXPECT_EQ(crowns_near(package, cell, distance), expected) << cell.i << ',' << cell.j << ' ' << distance;
      EXPECT_TRUE(distance < 1e9 || expected.size() == crown_count);
    }
}

TEST_F(Park, TheFrameIsThatOfTheCell) {
  const PackageReader package(folder);
  const std::vector<Crown> of_corner = crowns_of_whole_city(package, {0, 0}), of_other = crowns_of_whole_city(package, {2, 1});
  ASSERT_EQ(of_corner.size(), of_other.size());
  // Rounded to a float once in each frame, below 256 m
  constexpr double rounding_m = 2.0 * 128.0 * 0x1p-23;
  for (std::size_t n = 0; n < of_corner.size(); ++n) {
    EXPECT_NEAR(of_corner[n].x_m - of_other[n].x_m, 40.0, rounding_m);
    EXPECT_NEAR(of_corner[n].y_m - of_other[n].y_m, 20.0, rounding_m);
    EXPECT_EQ(of_corner[n].top_m, of_other[n].top_m);
    EXPECT_EQ(of_corner[n].turn, of_other[n].turn);
  }
}

TEST(PackageWithoutTrees, HasNoCrownsNear) {
  scenes::SceneBuilder builder;
  builder.add_box({{1.0, 1.0}, {4.0, 4.0}}, 0.0, 3.0);
  const scenes::TemporaryFolder temporary;
  const Grid grid = scenes::grid_covering(builder.city(), {}, 20.0, 1);
  scenes::pack_city(builder.city(), grid, temporary.path() / "a.farlod", scenes::box_maps(4, 4));
  const PackageReader package(temporary.path() / "a.farlod");
  EXPECT_TRUE(crowns_near(package, {0, 0}, 100.0).empty());
  EXPECT_TRUE(crowns_of_whole_city(package, {0, 0}).empty());
}

Crown spheroid(float x_m, float half_width_m, float bottom_m = 2.0F, float top_m = 8.0F) {
  return {x_m, 3.0F, bottom_m, top_m, half_width_m, CrownShape::spheroid, Foliage::deciduous, 0};
}

TEST(MergedCrowns, HideAsMuchAsOneThatStandsAlone) {
  constexpr double square_m = 10'000.0;
  const Crown merged_one = merged({spheroid(5.0F, 2.0F)}, square_m);
  EXPECT_EQ(merged_one.shape, CrownShape::cylinder);
  EXPECT_EQ(merged_one.foliage, Foliage::deciduous);
  // The area of the ellipse that one sees from the side
  const double height_m = static_cast<double>(merged_one.top_m - merged_one.bottom_m);
  EXPECT_NEAR(2.0 * static_cast<double>(merged_one.half_width_m) * height_m, std::numbers::pi * 2.0 * 3.0, 0.01);
  EXPECT_FLOAT_EQ(merged_one.x_m, 5.0F);
  EXPECT_FLOAT_EQ(merged_one.y_m, 3.0F);
}

TEST(MergedCrowns, StandWhereMostIsSeenOfThem) {
  const Crown both = merged({spheroid(0.0F, 3.0F, 0.0F, 10.0F), spheroid(8.0F, 1.0F, 4.0F, 6.0F)}, 10'000.0);
  EXPECT_NEAR(both.x_m, 2.0, 1e-4);
  EXPECT_NEAR(both.bottom_m, 1.0, 1e-4);
  EXPECT_NEAR(both.top_m, 9.0, 1e-4);
}

TEST(MergedCrowns, AreNoWiderThanTheirSquare) {
  const std::vector<Crown> forest(200, spheroid(5.0F, 4.0F));
  EXPECT_NEAR(merged(forest, 25.0).half_width_m, 12.5, 1e-3);
  // Chance leaves the share exp(−1) of a width free in which crowns of as much width stand
  const std::vector<Crown> grove(4, Crown{0, 0, 0, 1, 3.125F, CrownShape::cylinder, Foliage::unknown, 0});
  EXPECT_NEAR(merged(grove, 25.0).half_width_m, 12.5 * (1.0 - std::exp(-1.0)), 1e-3);
}

/// A box in the middle of 11 × 11 cells of 100 m, with one crown in each cell.
class ManyCells : public testing::Test {
 protected:
  ManyCells() : package_(packed()) {}
  [[nodiscard]] PackageReader packed() const {
    scenes::SceneBuilder scene;
    scene.add_box({{-549, -549}, {-545, -545}}, 0.0, 3.0);
    scene.add_box({{545, 545}, {549, 549}}, 0.0, 3.0);
    const Grid grid = scenes::grid_covering(scene.city(), {}, 100, 3);
    scenes::pack_city(scene.city(), grid, folder_.path() / "a.farlod", scenes::small_maps(FarMapKind::horizon));
    CrownsOfCity crowns = scenes::crowns_for(folder_.path() / "a.farlod");
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n)
      crowns.add(grid.corner_of(grid.cells.cell_at(n)) + Point2d{10.0, 20.0}, 2.0, 10.0, 2.0, CrownShape::spheroid,
                 Foliage::evergreen);
    scenes::plant(crowns, folder_.path() / "a.farlod");
    return PackageReader(folder_.path() / "a.farlod");
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
};

TEST_F(ManyCells, AreSeenFromACell) {
  const Cell cell{0, 0};
  const std::vector<Crown> crowns = canopy_around(package_, cell, 0.0F, {50.0, 25.0, 250.0, 100.0, 10'000.0});
  const auto named = std::ranges::count(crowns, CrownShape::spheroid, &Crown::shape);
  // Its own and those of the cells to the east and north lie within 50 m: at (110, 20), (10, 120) and (110, 120); to the west and
  // south they are 90 m and 80 m away
  EXPECT_EQ(named, 4);
  EXPECT_EQ(crowns.size(), static_cast<std::size_t>(package_.grid().cells.size()));
  EXPECT_TRUE(std::ranges::any_of(crowns, [](const Crown& c) { return c.x_m == 110.0F && c.y_m == 20.0F; }));
  EXPECT_EQ(crowns, canopy_around(package_, cell, 0.0F, {50.0, 25.0, 250.0, 100.0, 10'000.0}));
}

TEST_F(ManyCells, AreLeftOutBelowTheEyeAndBeyondTheFarthest) {
  EXPECT_TRUE(canopy_around(package_, {0, 0}, 1e4F).empty());
  EXPECT_EQ(canopy_around(package_, {0, 0}, 0.0F, {50.0, 25.0, 60.0, 100.0, 60.0}).size(), 4U);
}

}  // namespace
}  // namespace farlod
