// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/tiles/twice_area_vector.hpp"
#include "tiles/facet_triangulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tiles/exact_cutting_cgal.hpp"

namespace farlod::tiles {
namespace {

using Ring = std::vector<Point3d>;
using Rings = std::vector<Ring>;

std::vector<std::span<const Point3d>> spans(const Rings& rings) { return {rings.begin(), rings.end()}; }

ExactPoint exact(const Point3d& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }

/// Twice the area vector of a facet, exactly; holes must be drawn against the outer ring.
ExactPoint exact_area(const Rings& rings) {
  ExactPoint sum{Rational(0), Rational(0), Rational(0)};
  for (const Ring& ring : rings) {
    std::vector<ExactCorner> polygon;
    for (const Point3d& p : ring) polygon.push_back({exact(p), -1});
    sum = sum + twice_area_vector(polygon);
  }
  return sum;
}

ExactPoint exact_area(const Triangulation& t) {
  ExactPoint sum{Rational(0), Rational(0), Rational(0)};
  for (const Triangle& c : t.triangles)
    sum = sum + cross(exact(t.points[c.b]) - exact(t.points[c.a]), exact(t.points[c.c]) - exact(t.points[c.a]));
  return sum;
}

double area(const Triangulation& t) {
  double sum = 0.0;
  for (const Triangle& c : t.triangles) sum += 0.5 * norm(cross(t.points[c.b] - t.points[c.a], t.points[c.c] - t.points[c.a]));
  return sum;
}

/// A star of n points around a middle, in a tilted plane or, with `rough`, off it; holes run the other way.
Ring star(int n, double radius, const Point3d& middle, const Point3d& u, const Point3d& v, double rough, bool reverse,
          std::mt19937_64& random) {
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Ring ring;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n, r = radius * (0.6 + 0.4 * uniform());
    const Point3d off = rough * (uniform() - 0.5) * cross(u, v);
    ring.push_back(middle + r * std::cos(angle) * u + r * std::sin(angle) * v + off);
  }
  if (reverse) std::reverse(ring.begin(), ring.end());
  return ring;
}

TEST(Triangulate, KeepsTheExactAreaVectorOfRandomFacetsWithHoles) {
  std::mt19937_64 random(3);
  for (int n = 0; n < 200; ++n) {
    const Point3d u = normalized(Point3d{std::cos(0.1 * n), std::sin(0.1 * n), 0.3 * std::sin(0.7 * n)});
    const Point3d v = normalized(cross(Point3d{0.2, std::cos(0.3 * n), 1.0}, u));
    const Point3d middle{1000.0 + n, -300.0, 20.0};
    const double rough = n % 3 == 0 ? 0.3 : 0.0;  // every third is not planar
    Rings rings{star(3 + n % 20, 10, middle, u, v, rough, false, random)};
    if (n % 2 == 0) rings.push_back(star(5, 2, middle + 1.5 * u, u, v, rough, true, random));
    if (n % 4 == 0) rings.push_back(star(4, 1, middle - 2.5 * u, u, v, rough, true, random));
    if (rings[0].size() < 8 && rings.size() > 1) rings.resize(1);  // a triangle has no room for holes
    const Triangulation t = triangulate(spans(rings));
    EXPECT_FALSE(t.rings_cross) << n;
    EXPECT_TRUE(exact_area(t) == exact_area(rings)) << n;
  }
}

TEST(Triangulate, HolesCountWhicheverWayTheyRun) {
  const Ring outer{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, hole{{2, 2, 0}, {2, 4, 0}, {4, 4, 0}, {4, 2, 0}};
  const Ring turned(hole.rbegin(), hole.rend());
  EXPECT_EQ(area(triangulate(spans({outer, hole}))), 96.0);
  EXPECT_EQ(area(triangulate(spans({outer, turned}))), 96.0);
  EXPECT_EQ(area_vector(spans({outer, hole})), (Point3d{0, 0, 96}));
  EXPECT_EQ(area_vector(spans({outer, turned})), (Point3d{0, 0, 96}));
}

TEST(Triangulate, TrianglesRunRoundAsTheOuterRingDoes) {
  const Ring up{{0, 0, 0}, {10, 0, 0}, {10, 5, 0}, {5, 2, 0}, {0, 5, 0}};
  const Ring down(up.rbegin(), up.rend());
  for (const auto& [ring, sign] : {std::pair(up, 1.0), std::pair(down, -1.0)}) {
    const Triangulation t = triangulate(spans({ring}));
    ASSERT_EQ(t.triangles.size(), 3U);
    for (const Triangle& c : t.triangles)
      EXPECT_GT(sign * cross(t.points[c.b] - t.points[c.a], t.points[c.c] - t.points[c.a]).z, 0.0);
  }
}

TEST(Triangulate, AKeyholeIsAHole) {
  // The bridge from the outer ring to the hole is drawn there and back
  const Ring keyhole{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {0, 5, 0}, {4, 5, 0},
                     {4, 6, 0}, {6, 6, 0},  {6, 4, 0},   {4, 4, 0},  {4, 5, 0}, {0, 5, 0}};
  EXPECT_EQ(area(triangulate(spans({keyhole}))), 96.0);
}

TEST(Triangulate, ABowTieIsRepairedAndReported) {
  const Triangulation t = triangulate(spans({{{0, 0, 3}, {4, 4, 3}, {4, 0, 3}, {0, 6, 3}}}));
  EXPECT_TRUE(t.rings_cross);
  // Both wings, by even and odd: the crossing is at (2.4, 2.4)
  EXPECT_DOUBLE_EQ(area(t), 0.5 * 4 * 1.6 + 0.5 * 6 * 2.4);
  for (const Point3d& p : t.points) EXPECT_EQ(p.z, 3.0);
}

TEST(Triangulate, ABowTieWhoseWingsCancelIsRepairedToo) {
  const Triangulation t = triangulate(spans({{{0, 0, 3}, {4, 4, 3}, {4, 0, 3}, {0, 4, 3}}}));
  EXPECT_TRUE(t.rings_cross);
  EXPECT_DOUBLE_EQ(area(t), 8.0);
  EXPECT_DOUBLE_EQ(std::abs(area_vector(t).z), 8.0);
}

TEST(Triangulate, ABentFacetIsSeenAlongItsOwnNormal) {
  // Over a plane that rises by 45° the ring is a simple arrow; its barb lies 3 m above the plane, and seen from the top, which is
  // the side that the facet shows most of, it sticks out through the shaft
  const Point3d u{1, 0, 0}, v = normalized(Point3d{0, 1, 0.9}), n = cross(u, v);
  const auto at = [&](double x, double y, double off) { return x * u + y * v + off * n; };
  const Ring arrow{at(0, 0, 0), at(10, 0, 0), at(10, 10, 0), at(6, 10, 0), at(5, 1, 3), at(4, 10, 0), at(0, 10, 0)};
  const Triangulation t = triangulate(spans({arrow}));
  EXPECT_FALSE(t.rings_cross);
  EXPECT_EQ(t.points.size(), arrow.size());
  EXPECT_TRUE(exact_area(t) == exact_area(Rings{arrow}));
}

TEST(Triangulate, WhatHasNoAreaHasNoTriangles) {
  EXPECT_TRUE(triangulate(spans({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}})).triangles.empty());
  EXPECT_TRUE(triangulate(spans({{{0, 0, 0}, {1, 0, 0}}})).triangles.empty());
  EXPECT_TRUE(triangulate(spans({{{0, 0, 0}, {5, 0, 0}, {5, 0, 9}, {5, 0, 0}}})).triangles.empty());
}

TEST(DistanceFromPlane, IsThatOfTheWorstPoint) {
  EXPECT_DOUBLE_EQ(distance_from_plane_m(spans({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.25}, {0, 1, 0}}}), {0, 0, 1}), 0.25);
}

}  // namespace
}  // namespace farlod::tiles
