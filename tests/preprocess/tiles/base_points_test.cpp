// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/base_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

bool has_point_at(const std::vector<Point3d>& points, double height_m) {
  return std::any_of(points.begin(), points.end(), [height_m](const Point3d& p) { return p.z == height_m; });
}

TEST(BasePoints, AreTheLowestOfEachBuilding) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 3.0, 20.0);
  const auto points = base_points(town.city());
  EXPECT_TRUE(has_point_at(points, 3.0));
  EXPECT_FALSE(has_point_at(points, 20.0));
}

TEST(BasePoints, ABridgeBetweenHousesHangs) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{20, 0}, {30, 10}}, 0.0, 20.0);
  town.add_box({{10, 4}, {20, 6}}, 6.0, 9.0);
  EXPECT_FALSE(has_point_at(base_points(town.city()), 6.0));
}

TEST(BasePoints, HousesOnASteepStreetStandOnTheGround) {
  scenes::SceneBuilder town;
  for (int n = 0; n < 6; ++n)
    town.add_box({{20.0 * n, 0}, {20.0 * n + 10, 10}}, 5.0 * n, 5.0 * n + 10);  // 5 m up in 10 m of street
  for (int n = 0; n < 6; ++n) EXPECT_TRUE(has_point_at(base_points(town.city()), 5.0 * n)) << n;
}

TEST(BasePoints, AHouseFarFromAllOthersStandsWhereverItIs) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{10 + base_search_radius_m * 2, 0}, {20 + base_search_radius_m * 2, 10}}, 500.0, 510.0);
  EXPECT_TRUE(has_point_at(base_points(town.city()), 500.0));
}

}  // namespace
}  // namespace farlod
