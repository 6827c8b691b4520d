// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/base_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "tests/scenes/scene_builder.hpp"

namespace farlod::tiles {
namespace {

bool has_point_at(std::span<const Point3d> points, double height_m) {
  return std::any_of(points.begin(), points.end(), [height_m](const Point3d& p) { return p.z == height_m; });
}

PagedArray<Point3d> base_points(const CityModel& city) { return tiles::base_points(city, bases_of(city)); }

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

TEST(BasePoints, TouchingHousesOnAHillStandOnTheGround) {
  constexpr double slope = 0.25, width_m = 10.0;
  for (const double turn : {1.0, -1.0}) {
    scenes::SceneBuilder town;
    for (int n = 0; n < 8; ++n)
      town.add_box({{width_m * n, 0}, {width_m * (n + 1), 12}}, 100 + turn * slope * width_m * n,
                   120 + turn * slope * width_m * n);
    const std::vector<Base> bases = bases_of(town.city());
    EXPECT_EQ(std::count(bases.begin(), bases.end(), Base::on_ground), 8) << turn;
  }
}

TEST(BasePoints, ARoofFarAboveItsOneNeighborHangs) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{10, 0}, {14, 4}}, 15.0, 16.0);
  EXPECT_EQ(bases_of(town.city())[1], Base::above_ground);
}

TEST(BasePoints, AWrongBaseDigsNoPit) {
  scenes::SceneBuilder town;
  for (int n = 0; n < 5; ++n) town.add_box({{12.0 * n, 0}, {12.0 * n + 10, 10}}, n == 2 ? 0.0 : 60.0, 75.0);
  const std::vector<Base> bases = bases_of(town.city());
  for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(bases[n], n == 2 ? Base::below_ground : Base::on_ground) << n;
  EXPECT_FALSE(has_point_at(base_points(town.city()), 0.0));
}

TEST(BasePoints, OneHouseBelowAnotherIsNoError) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{12, 0}, {22, 10}}, 60.0, 75.0);
  EXPECT_EQ(bases_of(town.city())[0], Base::on_ground) << "nobody can tell which of two is wrong";
}

}  // namespace
}  // namespace farlod::tiles
