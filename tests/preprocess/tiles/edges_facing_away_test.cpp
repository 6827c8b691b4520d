// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "package/edge_facing.hpp"
#include "tests/preprocess/tiles/random_bodies.hpp"
#include "tiles/horizon_edges.hpp"

// The oracle of may_be_silhouette for upper borders: closed bodies on the ground, eyes outside of them, and the horizon that each
// eye has with and without the edges that are said to be none.

namespace farlod::tiles {
namespace {

using test::Body;
using test::Count;
using test::Face;
using test::Highest;
using test::RandomCity;
using test::rounding_m;

/// Fans of triangles, as far as they bear: a table knows each body by itself.
std::vector<HorizonSegment> horizon_edges_of(const std::vector<Body>& bodies) {
  std::vector<HorizonSegment> edges;
  for (const Body& body : bodies) {
    EdgeTable table;
    for (const Face& face : body)
      for (std::size_t n = 2; n < face.size(); ++n) table.add_triangle(face[0], face[n - 1], face[n], FacetLook::up);
    const auto own = table.horizon_edges();
    edges.insert(edges.end(), own.begin(), own.end());
  }
  return edges;
}

Highest highest_of(const std::vector<HorizonSegment>& edges, const Point3d& eye, Point2d ahead) {
  Highest highest;
  for (const HorizonSegment& edge : edges) {
    const Point3d a = edge.segment.a - eye, b = edge.segment.b - eye;
    const double aside_a = ahead.x * a.y - ahead.y * a.x, aside_b = ahead.x * b.y - ahead.y * b.x;
    if (aside_a * aside_b > 0.0 || aside_a == aside_b) continue;
    const Point3d p = a + aside_a / (aside_a - aside_b) * (b - a);
    const double distance_m = dot(horizontal(p), ahead);
    if (distance_m > 0.0 && p.z / distance_m > highest.slope) highest = {p.z / distance_m, distance_m};
  }
  return highest;
}

/// What an eye loses by the edges that were left out, in metres where they stand. Ends of edges less than two slacks above the
/// eye are taken for no higher than it.
void expect_nothing_lost(const std::vector<HorizonSegment>& all, const std::vector<HorizonSegment>& kept, const Point3d& eye,
                         RandomCity& random) {
  for (int n = 0; n < 40; ++n) {
    const double azimuth = random.between(0.0, 2.0 * std::numbers::pi);
    const Point2d ahead{std::cos(azimuth), std::sin(azimuth)};
    const Highest with = highest_of(all, eye, ahead), without = highest_of(kept, eye, ahead);
    EXPECT_LE((with.slope - without.slope) * with.distance_m, 2.0 * facing_slack_m + rounding_m)
        << "from (" << eye.x << ", " << eye.y << ", " << eye.z << ") at " << azimuth;
  }
}

void compare_edges(RandomCity& random, double box_edge_m, Count& count) {
  const std::vector<Body> bodies = random.bodies();
  const std::vector<HorizonSegment> edges = horizon_edges_of(bodies);
  test::compare_for_a_box(bodies, edges, box_edge_m, random, count,
                          [&](const auto& kept, const Point3d& eye) { expect_nothing_lost(edges, kept, eye, random); });
}

class EdgesFacingAway : public testing::TestWithParam<double> {};

TEST_P(EdgesFacingAway, AreNoHorizonForAnyEyeOutside) {
  RandomCity random(42);
  Count count;
  for (int n = 0; n < 4000 && !HasFailure(); ++n) compare_edges(random, GetParam(), count);
  EXPECT_GT(count.looks, 2000) << "the test tests nothing";
  EXPECT_GT(count.away, count.seen / 4) << "the test tests nothing";
}

INSTANTIATE_TEST_SUITE_P(BoxesOfEyes, EdgesFacingAway, testing::Values(0.0, 1.0, 10.0),
                         [](const auto& instance) { return "Edge" + std::to_string(static_cast<int>(instance.param)) + "m"; });

}  // namespace
}  // namespace farlod::tiles
