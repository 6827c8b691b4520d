// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/near_crowns.hpp"

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

}  // namespace
}  // namespace farlod
