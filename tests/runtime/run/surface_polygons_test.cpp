// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "farlod/inspection.hpp"

namespace farlod {
namespace {

using SpaceTriangle = std::array<Point3d, 3>;

/// A rectangle of a leaning plane as two triangles; `x` and `y` are places in it.
std::vector<SpaceTriangle> rectangle(double x0, double y0, double x1, double y1) {
  const auto at = [](double x, double y) { return Point3d{x, y, 0.5 * x + 7.0}; };
  return {{at(x0, y0), at(x1, y0), at(x1, y1)}, {at(x0, y0), at(x1, y1), at(x0, y1)}};
}

std::vector<SpaceTriangle> together(const std::vector<std::vector<SpaceTriangle>>& parts) {
  std::vector<SpaceTriangle> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Around a hole from 10 to 20.
std::vector<SpaceTriangle> frame() {
  return together({rectangle(0, 0, 10, 10), rectangle(10, 0, 20, 10), rectangle(20, 0, 30, 10), rectangle(0, 10, 10, 20),
                   rectangle(20, 10, 30, 20), rectangle(0, 20, 10, 30), rectangle(10, 20, 20, 30), rectangle(20, 20, 30, 30)});
}

/// Of a ring in the plan, positive where it runs counter-clockwise.
double plan_area(const std::vector<Point3d>& ring) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point3d &a = ring[k], &b = ring[(k + 1) % ring.size()];
    sum += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return sum;
}

TEST(SurfacePolygons, AreTheOutlineOfTriangles) {
  const auto polygons = polygons_of(rectangle(2, 3, 12, 9));
  ASSERT_EQ(polygons.size(), 1U);
  EXPECT_EQ(polygons[0].shell.size(), 4U);
  EXPECT_TRUE(polygons[0].holes.empty());
  EXPECT_DOUBLE_EQ(plan_area(polygons[0].shell), 60.0);
  for (const Point3d& p : polygons[0].shell) EXPECT_EQ(p.z, 0.5 * p.x + 7.0);
}

TEST(SurfacePolygons, HaveHolesThatRunTheOtherWay) {
  const auto polygons = polygons_of(frame());
  ASSERT_EQ(polygons.size(), 1U);
  ASSERT_EQ(polygons[0].holes.size(), 1U);
  EXPECT_DOUBLE_EQ(plan_area(polygons[0].shell), 900.0);
  EXPECT_DOUBLE_EQ(plan_area(polygons[0].holes[0]), -100.0);
}

TEST(SurfacePolygons, AHoleBelongsToWhatSurroundsIt) {
  std::vector<SpaceTriangle> far = rectangle(100, 0, 110, 10);
  const auto polygons = polygons_of(together({far, frame()}));
  ASSERT_EQ(polygons.size(), 2U);
  const std::size_t framed = polygons[0].shell[0].x < 50.0 ? 0 : 1;
  EXPECT_EQ(polygons[framed].holes.size(), 1U);
  EXPECT_TRUE(polygons[1 - framed].holes.empty());
}

TEST(SurfacePolygons, PiecesThatTouchInACornerAreTwo) {
  const auto polygons = polygons_of(together({rectangle(0, 0, 10, 10), rectangle(10, 10, 20, 20)}));
  ASSERT_EQ(polygons.size(), 2U);
  for (const SurfacePolygon& p : polygons) EXPECT_DOUBLE_EQ(plan_area(p.shell), 100.0);
}

TEST(SurfacePolygons, PiecesOfTwoCellsBecomeOneWhateverTheirRounding) {
  // On both sides of the border of a bucket, too
  for (const double shift : {0.0004, -0.0004, 0.0008}) {
    const auto polygons = polygons_of(together({rectangle(0, 0, 10, 10), rectangle(10.0 + shift, 0, 20, 10)}));
    ASSERT_EQ(polygons.size(), 1U) << shift;
    EXPECT_EQ(polygons[0].shell.size(), 6U) << shift;
  }
  EXPECT_EQ(polygons_of(together({rectangle(0, 0, 10, 10), rectangle(10.005, 0, 20, 10)})).size(), 2U);
}

TEST(SurfacePolygons, WhatIsNotAMillimetreWideIsLeftOut) {
  const std::vector<SpaceTriangle> sliver{{{{40.0, 0.0, 0.0}, {60.0, 0.0, 0.0}, {50.0, 0.0008, 0.0}}}};
  EXPECT_EQ(polygons_of(together({rectangle(0, 0, 10, 10), sliver})).size(), 1U);
  // But where there is nothing else
  EXPECT_EQ(polygons_of(sliver).size(), 1U);
  const std::vector<SpaceTriangle> speck{{{{0.0, 0.0, 0.0}, {0.0005, 0.0, 0.0}, {0.0, 0.0005, 0.0}}}};
  ASSERT_EQ(polygons_of(speck).size(), 1U);
  EXPECT_EQ(polygons_of(speck)[0].shell.size(), 3U);
  EXPECT_TRUE(polygons_of({}).empty());
}

TEST(SurfacePolygons, AreTrianglesWhereThoseHaveNoOutline) {
  std::vector<SpaceTriangle> both_sides = rectangle(0, 0, 10, 10);
  for (const auto& [a, b, c] : rectangle(0, 0, 10, 10)) both_sides.push_back({a, c, b});
  EXPECT_EQ(polygons_of(both_sides).size(), 4U);
  // A ridge
  std::vector<SpaceTriangle> fold = rectangle(0, 0, 10, 10);
  for (SpaceTriangle t : rectangle(10, 0, 20, 10)) {
    for (Point3d& p : t) p.z = 24.0 - p.z;
    fold.push_back(t);
  }
  EXPECT_EQ(polygons_of(fold).size(), 4U);
}

}  // namespace
}  // namespace farlod
