// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "package/edge_facing.hpp"
#include "tests/preprocess/tiles/borders.hpp"
#include "tests/preprocess/tiles/random_bodies.hpp"
#include "tiles/horizon_edges.hpp"

// The oracle of may_be_silhouette for lower borders: closed convex bodies that float, eyes outside of them. In the upright
// half-plane of an azimuth each body hides the slopes from its lowest one on; no body may begin above the highest lower border
// that is kept.

namespace farlod::tiles {
namespace {

using test::Body;
using test::Count;
using test::Face;
using test::Highest;
using test::RandomCity;
using test::rounding_m;

/// A body lifted off the ground, or turned upside down as well.
Body floating(Body body, RandomCity& random) {
  const double lift_m = random.between(0.5, 15.0);
  const bool is_turned = random.toss();
  double high_m = 0.0;
  for (const Face& face : body)
    for (const Point3d& p : face) high_m = std::max(high_m, p.z);
  for (Face& face : body) {
    for (Point3d& p : face) p.z = lift_m + (is_turned ? high_m - p.z : p.z);
    if (is_turned) std::reverse(face.begin(), face.end());
  }
  return body;
}

struct Crossing {
  double slope, distance_m;
};
template <class Visit>
void for_each_crossing(const Point3d& a_grid, const Point3d& b_grid, const Point3d& eye, Point2d ahead, const Visit& visit) {
  const Point3d a = a_grid - eye, b = b_grid - eye;
  const double aside_a = ahead.x * a.y - ahead.y * a.x, aside_b = ahead.x * b.y - ahead.y * b.x;
  if (aside_a * aside_b > 0.0 || aside_a == aside_b) return;
  const Point3d p = a + aside_a / (aside_a - aside_b) * (b - a);
  const double distance_m = dot(horizontal(p), ahead);
  if (distance_m > 0.0) visit(Crossing{p.z / distance_m, distance_m});
}

/// Where the body begins that begins highest.
Highest highest_beginning(const std::vector<Body>& bodies, const Point3d& eye, Point2d ahead) {
  Highest highest;
  for (const Body& body : bodies) {
    Crossing lowest{std::numeric_limits<double>::infinity(), 0.0};
    for (const Face& face : body)
      for (std::size_t n = 0; n < face.size(); ++n)
        for_each_crossing(face[n], face[(n + 1) % face.size()], eye, ahead, [&](const Crossing& c) {
          if (c.slope < lowest.slope) lowest = c;
        });
    if (std::isfinite(lowest.slope) && lowest.slope > highest.slope) highest = {lowest.slope, lowest.distance_m};
  }
  return highest;
}

double highest_border(const std::vector<HorizonSegment>& borders, const Point3d& eye, Point2d ahead) {
  double highest = 0.0;
  for (const HorizonSegment& border : borders)
    for_each_crossing(border.segment.a, border.segment.b, eye, ahead,
                      [&](const Crossing& c) { highest = std::max(highest, c.slope); });
  return highest;
}

void expect_nothing_lost(const std::vector<Body>& bodies, const std::vector<HorizonSegment>& kept, const Point3d& eye,
                         RandomCity& random) {
  for (int n = 0; n < 40; ++n) {
    const double azimuth = random.between(0.0, 2.0 * std::numbers::pi);
    const Point2d ahead{std::cos(azimuth), std::sin(azimuth)};
    const Highest begins = highest_beginning(bodies, eye, ahead);
    EXPECT_LE((begins.slope - highest_border(kept, eye, ahead)) * begins.distance_m, 2.0 * facing_slack_m + rounding_m)
        << "from (" << eye.x << ", " << eye.y << ", " << eye.z << ") at " << azimuth;
  }
}

void compare_borders(RandomCity& random, double box_edge_m, Count& count) {
  std::vector<Body> bodies;
  std::vector<HorizonSegment> borders;
  for (const Body& body : random.bodies()) {
    bodies.push_back(floating(body, random));
    const std::vector<HorizonSegment> own = undersides(test::table_of(bodies.back()).edges());
    borders.insert(borders.end(), own.begin(), own.end());
  }
  for (const HorizonSegment& e : borders) EXPECT_EQ(e.role, EdgeRole::underside);
  test::compare_for_a_box(bodies, borders, box_edge_m, random, count,
                          [&](const auto& kept, const Point3d& eye) { expect_nothing_lost(bodies, kept, eye, random); });
}

class BordersFacingAway : public testing::TestWithParam<double> {};

TEST_P(BordersFacingAway, AreLowestForNoEyeOutside) {
  RandomCity random(43);
  Count count;
  for (int n = 0; n < 4000 && !HasFailure(); ++n) compare_borders(random, GetParam(), count);
  EXPECT_GT(count.looks, 2000) << "the test tests nothing";
  EXPECT_GT(count.away, count.seen / 4) << "the test tests nothing";
}

INSTANTIATE_TEST_SUITE_P(BoxesOfEyes, BordersFacingAway, testing::Values(0.0, 1.0, 10.0),
                         [](const auto& instance) { return "Edge" + std::to_string(static_cast<int>(instance.param)) + "m"; });

}  // namespace
}  // namespace farlod::tiles
