// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/plan_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "occlusion/occluder.hpp"

namespace farlod {
namespace {

using Crossings = std::vector<PlanCrossing>;

Crossings crossings_at(const PlanIndex& index, float x, float y) {
  Crossings found;
  index.find(x, y, found);
  return found;
}

/// Two triangles of a square, split along its diagonal.
std::vector<PlanTriangle> square(float edge_m, float z_m) {
  const Point3f a{0, 0, z_m}, b{edge_m, 0, z_m}, c{edge_m, edge_m, z_m}, d{0, edge_m, z_m};
  return {{a, b, c}, {a, c, d}};
}

TEST(PlanIndex, OfNothingFindsNothing) { EXPECT_TRUE(crossings_at(PlanIndex({}), 1.0F, 2.0F).empty()); }

TEST(PlanIndex, FindsWhatLiesOverAPlace) {
  const PlanIndex index(square(10.0F, 4.0F));
  const Crossings found = crossings_at(index, 7.0F, 2.0F);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].triangle, 0U);
  EXPECT_EQ(found[0].height_m, 4.0F);
  EXPECT_TRUE(crossings_at(index, 10.1F, 2.0F).empty());
  EXPECT_TRUE(crossings_at(index, -0.1F, 2.0F).empty());
}

TEST(PlanIndex, APlaceOnACommonEdgeIsInBothTriangles) {
  EXPECT_EQ(crossings_at(PlanIndex(square(10.0F, 4.0F)), 3.0F, 3.0F).size(), 2U);
  EXPECT_EQ(crossings_at(PlanIndex(square(10.0F, 4.0F)), 0.0F, 0.0F).size(), 2U);
}

TEST(PlanIndex, UprightTrianglesCoverNothing) {
  const PlanIndex index({{Point3f{0, 0, 0}, Point3f{10, 0, 0}, Point3f{10, 0, 5}}});
  EXPECT_TRUE(crossings_at(index, 5.0F, 0.0F).empty());
}

/// (1): whatever the slope of an edge, a place next to it is on one side of it or on the other.
TEST(PlanIndex, NoPlaceFallsBetweenNeighbors) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(0.0F, 50.0F), share(0.0F, 1.0F);
  for (int n = 0; n < 2000; ++n) {
    const Point3f a{coordinate(random), coordinate(random), 1.0F}, b{coordinate(random), coordinate(random), 2.0F};
    // Two triangles on the two sides of a–b
    const Point3f aside{0.5F * (b.y - a.y), 0.5F * (a.x - b.x), 0.0F}, middle = 0.5F * (a + b);
    const PlanIndex index({{a, b, middle + aside}, {b, a, middle - aside}});
    const float s = share(random);
    const Point3f p = a + s * (b - a);
    EXPECT_GE(crossings_at(index, p.x, p.y).size(), 1U) << n;
  }
}

/// In the doubles of `side_of`, a place beyond the end of a sliver may lie on all three of its sides.
TEST(PlanIndex, ASliverEndsAtItsCorners) {
  const float x = std::nextafter(100.0F, 200.0F);
  const PlanTriangle sliver{Point3f{0, 0, 0}, Point3f{100, 100, 0}, Point3f{1e-30F, 0, 0}};
  EXPECT_NE(plan_area(sliver), 0.0);
  EXPECT_TRUE(covers(sliver, 50.0F, 50.0F));
  EXPECT_FALSE(covers(sliver, x, x));
  EXPECT_TRUE(crossings_at(PlanIndex({sliver}), x, x).empty());
}

/// All triangles along a ray, from near to far.
std::vector<Hit> all_hits(const Occluder& occluder, const Ray& ray) {
  std::vector<Hit> hits;
  std::set<std::uint32_t> met;
  while (const auto hit = occluder.nearest(ray, [&met](std::uint32_t t) { return !met.contains(t); })) {
    hits.push_back(*hit);
    met.insert(hit->triangle);
  }
  return hits;
}

/// The oracle: upright rays through all triangles.
TEST(PlanIndex, AgreesWithUprightRays) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(-20.0F, 70.0F), height(0.0F, 30.0F);
  std::vector<PlanTriangle> triangles;
  std::vector<Point3f> vertices;
  std::vector<Triangle> numbers;
  for (std::uint32_t n = 0; n < 300; ++n) {
    PlanTriangle corners;
    for (Point3f& p : corners) p = {coordinate(random), coordinate(random), height(random)};
    triangles.push_back(corners);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
    numbers.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  }
  const PlanIndex index(triangles);
  const Occluder occluder(vertices, numbers);
  constexpr float below_all_m = -1.0F, tolerance_m = 1e-3F;  // Embree rounds the distance of hits on steep triangles
  for (int n = 0; n < 500; ++n) {
    const float x = coordinate(random), y = coordinate(random);
    Crossings found = crossings_at(index, x, y);
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.height_m < b.height_m; });
    const std::vector<Hit> hits = all_hits(occluder, {{x, y, below_all_m}, {0.0F, 0.0F, 1.0F}});
    ASSERT_EQ(found.size(), hits.size()) << x << ", " << y;
    for (std::size_t k = 0; k < hits.size(); ++k) EXPECT_NEAR(found[k].height_m, below_all_m + hits[k].distance, tolerance_m);
  }
}

}  // namespace
}  // namespace farlod
