// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/ground_border.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/preprocess/tiles/whole_ground.hpp"
#include "tiles/ground.hpp"

namespace farlod::tiles {
namespace {

const Box2d square_km{{0, 0}, {1000, 1000}};

/// A hill beside the middle of the east border, and houses at its foot near all corners.
const std::vector<Point3d> hill{{950, 500, 600}, {950, 40, 500}, {950, 960, 500}, {40, 40, 500}, {40, 960, 500}};

NearestHeight nearest_of(const std::vector<Point3d>& points, Point2d p) {
  NearestHeight nearest{0.0, std::numeric_limits<double>::infinity()};
  for (const Point3d& q : points)
    if (const double distance_m = norm(horizontal(q) - p); distance_m < nearest.distance_m) nearest = {q.z, distance_m};
  return nearest;
}

std::vector<Point3d> nodes_around(const std::vector<Point3d>& points) {
  return border_nodes(square_km, [&](Point2d p) { return std::optional(nearest_of(points, p)); });
}

TEST(GroundBorder, HasNodesAsCloseAsKnownHeightsAreNear) {
  std::vector<Point3d> slope;
  for (int n = 0; n < 40; ++n) slope.push_back({990.0, 5.0 + 25.0 * n, static_cast<double>(n)});
  const std::vector<Point3d> nodes = nodes_around(slope);
  for (const Point2d corner : {Point2d{0, 0}, Point2d{1000, 0}, Point2d{1000, 1000}, Point2d{0, 1000}})
    EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [&](const Point3d& p) { return horizontal(p) == corner; }));
  const auto on_east = std::count_if(nodes.begin(), nodes.end(), [](const Point3d& p) { return p.x == 1000.0; });
  const auto on_south = std::count_if(nodes.begin(), nodes.end(), [](const Point3d& p) { return p.y == 0.0; });
  EXPECT_GT(on_east, 40) << "10 to 16 m away";
  EXPECT_LT(on_south, 20) << "up to 990 m away";
}

TEST(GroundBorder, IsNoSteeperThanWhatItIsNearTo) {
  std::vector<Point3d> nodes = nodes_around(hill);
  std::erase_if(nodes, [](const Point3d& p) { return p.x != 1000.0; });
  std::sort(nodes.begin(), nodes.end(), [](const Point3d& a, const Point3d& b) { return a.y < b.y; });
  ASSERT_GT(nodes.size(), 4U);
  constexpr double slope_of_hill = 100.0 / 460.0;
  for (std::size_t n = 1; n < nodes.size(); ++n)
    EXPECT_LE(std::abs(nodes[n].z - nodes[n - 1].z), 2.5 * slope_of_hill * (nodes[n].y - nodes[n - 1].y)) << nodes[n].y;
}

TEST(GroundBorder, HasItsCornersAloneWhereAllIsLevel) {
  std::vector<Point3d> level = hill;
  for (Point3d& p : level) p.z = 432.1;
  const std::vector<Point3d> nodes = nodes_around(level);
  ASSERT_EQ(nodes.size(), 4U);
  for (const Point3d& p : nodes) EXPECT_EQ(p.z, 432.1);
}

TEST(GroundBorder, HasNoNodesBetweenKnownHeights) {
  // Heights are known in the west half
  const auto beyond = [](Point2d p) -> std::optional<NearestHeight> {
    if (p.x <= 500.0) return std::nullopt;
    return NearestHeight{p.y, p.x - 500.0};
  };
  const std::vector<Point3d> nodes = border_nodes(square_km, beyond);
  EXPECT_GT(nodes.size(), 4U);
  for (const Point3d& p : nodes) EXPECT_GT(p.x, 500.0);
}

/// Two kerbs across a slope: the ground between them is a plane, however near the border is to its long edges.
TEST(GroundBorder, LeavesWhatIsKnownAsItIs) {
  const auto height_m = [](double x) { return 100.0 + 0.25 * x; };
  std::vector<Point3d> kerbs;
  for (const double x : {1.0, 999.0})
    for (const double y : {2.0, 997.0}) kerbs.push_back({x, y, height_m(x)});
  const Ground ground(kerbs, square_km);
  for (const double x : {1.0, 30.0, 500.0, 998.0})
    for (const double y : {2.5, 300.0, 996.5}) EXPECT_NEAR(ground.height_at({x, y}), height_m(x), 1e-9) << x << ' ' << y;
  // And it goes on as high as it is where it ends, between two kerbs, too
  for (const double x : {300.0, 500.0, 700.0}) EXPECT_NEAR(ground.height_at({x, 0.5}), height_m(x), 1.0) << x;
}

TEST(GroundBorder, MakesNoRampBesideAHill) {
  const Ground ground(hill, square_km);
  // The border, 50 m away, has the mean of what lies as far to both sides of the hill, which falls by 100 m in 460 m
  for (double x = 950.0; x <= 1000.0; x += 5.0) EXPECT_NEAR(ground.height_at({x, 500.0}), 600.0, 0.5 * 50.0 * 100.0 / 460.0) << x;
  const std::vector<Point3d> reversed(hill.rbegin(), hill.rend());
  EXPECT_EQ(test::triangles_of(Ground(reversed, square_km)), test::triangles_of(ground));
}

}  // namespace
}  // namespace farlod::tiles
