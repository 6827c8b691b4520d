// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "farlod/box.hpp"
#include "package/horizon_edge.hpp"
#include "tests/preprocess/tiles/bodies.hpp"
#include "tests/preprocess/tiles/borders.hpp"
#include "tiles/horizon_edges.hpp"

// The oracle of may_be_silhouette for upper borders: closed bodies on the ground, eyes outside of them, and the horizon that each
// eye has with and without the edges that are said to be none.

namespace farlod::tiles {
namespace {

using test::Face;

/// A place within this many metres of the origin is rounded by a few times this.
constexpr double reach_m = 128.0;
constexpr double place_rounding_m = 8 * reach_m * std::numeric_limits<double>::epsilon();

/// A convex body, each face convex and seen counter-clockwise from outside.
using Body = std::vector<Face>;

bool is_inside(const Body& body, const Point3d& p) {
  return std::all_of(body.begin(), body.end(),
                     [&](const Face& face) { return dot(cross(face[1] - face[0], face[2] - face[0]), p - face[0]) < 0.0; });
}

class RandomCity {
 public:
  explicit RandomCity(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  [[nodiscard]] bool toss() { return random_() % 2 == 0; }
  [[nodiscard]] Point2d place() { return {between(-50, 50), between(-50, 50)}; }

  /// Upright walls below a roof that is one plane, level or not; or a level roof and sides that lean inwards.
  [[nodiscard]] Body prism() {
    const std::size_t corners = 3 + random_() % 5;
    const Point2d middle = place(), radius{between(3, 20), between(3, 20)};
    const double turn = between(0, 6), height_m = between(3, 30), shrink = toss() ? 1.0 : between(0.3, 0.95);
    const bool is_level = shrink < 1.0 || toss();
    const Point2d tilt{is_level ? 0.0 : between(-0.1, 0.1), is_level ? 0.0 : between(-0.1, 0.1)};
    Face foot, top;
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle = turn + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
      const Point2d out{radius.x * std::cos(angle), radius.y * std::sin(angle)};
      foot.push_back({middle.x + out.x, middle.y + out.y, 0.0});
      top.push_back({middle.x + shrink * out.x, middle.y + shrink * out.y, height_m + dot(tilt, out)});
    }
    Body body{top, Face(foot.rbegin(), foot.rend())};
    for (std::size_t k = 0; k < corners; ++k) {
      const std::size_t next = (k + 1) % corners;
      body.push_back({foot[k], foot[next], top[next], top[k]});
    }
    return body;
  }

  /// A house with a gable at either end, or with hips.
  [[nodiscard]] Body house() {
    const Point2d middle = place();
    const double x = between(4, 20), y = between(3, 10), eaves_m = between(2, 12), ridge_m = eaves_m + between(1, 8);
    const double turn = between(0, 6), ridge_x = toss() ? x : between(0.1, 0.9) * x;
    const auto p = [&](double east, double north, double up) {
      return Point3d{middle.x + east * std::cos(turn) - north * std::sin(turn),
                     middle.y + east * std::sin(turn) + north * std::cos(turn), up};
    };
    const Face foot{p(-x, -y, 0), p(x, -y, 0), p(x, y, 0), p(-x, y, 0)};
    const Face eaves{p(-x, -y, eaves_m), p(x, -y, eaves_m), p(x, y, eaves_m), p(-x, y, eaves_m)};
    const Point3d west = p(-ridge_x, 0, ridge_m), east = p(ridge_x, 0, ridge_m);
    Body body{Face(foot.rbegin(), foot.rend()),
              {eaves[0], eaves[1], east, west},
              {eaves[2], eaves[3], west, east},
              {eaves[1], eaves[2], east},
              {eaves[3], eaves[0], west}};
    for (std::size_t k = 0; k < 4; ++k) body.push_back({foot[k], foot[(k + 1) % 4], eaves[(k + 1) % 4], eaves[k]});
    return body;
  }

  [[nodiscard]] std::vector<Body> bodies() {
    std::vector<Body> result;
    for (std::size_t n = 1 + random_() % 4; n > 0; --n) result.push_back(toss() ? prism() : house());
    return result;
  }

 private:
  std::mt19937_64 random_;
};

/// The highest thing above the horizontal at an azimuth, as slope, and how far away it is.
struct HighestThing {
  double slope = 0.0, distance_m = 0.0;
};

/// A box of eyes.
struct EyeBox {
  Box2d plan;
  double low_m, high_m;
};

struct Count {
  int seen = 0, away = 0, looks = 0;
};

/// Leaves out the edges that face away from all eyes of a random box, and calls expect_nothing_lost(kept, eye) for some eyes of
/// the box that are outside of the bodies.
template <class ExpectNothingLost>
void compare_for_a_box(const std::vector<Body>& bodies, const std::vector<HorizonSegment>& edges, double box_edge_m,
                       RandomCity& random, Count& count, const ExpectNothingLost& expect_nothing_lost) {
  const Point2d corner = random.place();
  const double low_m = random.between(0.0, 20.0);
  const EyeBox eyes{{corner, corner + Point2d{box_edge_m, box_edge_m}}, low_m, low_m + 0.5 * box_edge_m};
  std::vector<HorizonSegment> kept;
  for (const HorizonSegment& e : edges)
    if (may_be_silhouette(e.segment.a, e.segment.b, e.adjacent, e.role, eyes.plan, eyes.low_m, eyes.high_m)) kept.push_back(e);
  count.seen += static_cast<int>(edges.size());
  count.away += static_cast<int>(edges.size() - kept.size());
  for (int n = 0; n < (box_edge_m == 0.0 ? 1 : 5); ++n) {
    const Point3d eye{random.between(eyes.plan.low.x, eyes.plan.high.x), random.between(eyes.plan.low.y, eyes.plan.high.y),
                      random.between(eyes.low_m, eyes.high_m)};
    if (std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) { return is_inside(body, eye); })) continue;
    expect_nothing_lost(kept, eye);
    ++count.looks;
  }
}

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

HighestThing highest_of(const std::vector<HorizonSegment>& edges, const Point3d& eye, Point2d ahead) {
  HighestThing highest;
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
    const HighestThing with = highest_of(all, eye, ahead), without = highest_of(kept, eye, ahead);
    EXPECT_LE((with.slope - without.slope) * with.distance_m, 2.0 * facing_slack_m + place_rounding_m)
        << "from (" << eye.x << ", " << eye.y << ", " << eye.z << ") at " << azimuth;
  }
}

void compare_edges(RandomCity& random, double box_edge_m, Count& count) {
  const std::vector<Body> bodies = random.bodies();
  const std::vector<HorizonSegment> edges = horizon_edges_of(bodies);
  compare_for_a_box(bodies, edges, box_edge_m, random, count,
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

// The oracle of may_be_silhouette for lower borders: closed convex bodies that float, eyes outside of them. In the upright
// half-plane of an azimuth each body hides the slopes from its lowest one on; no body may begin above the highest lower border
// that is kept.

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
HighestThing highest_beginning(const std::vector<Body>& bodies, const Point3d& eye, Point2d ahead) {
  HighestThing highest;
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
    const HighestThing begins = highest_beginning(bodies, eye, ahead);
    EXPECT_LE((begins.slope - highest_border(kept, eye, ahead)) * begins.distance_m, 2.0 * facing_slack_m + place_rounding_m)
        << "from (" << eye.x << ", " << eye.y << ", " << eye.z << ") at " << azimuth;
  }
}

void compare_borders(RandomCity& random, double box_edge_m, Count& count) {
  std::vector<Body> bodies;
  std::vector<HorizonSegment> borders;
  for (const Body& body : random.bodies()) {
    bodies.push_back(floating(body, random));
    std::vector<ClosingTriangle> closing;
    const std::vector<HorizonSegment> own = undersides(test::table_of(bodies.back()).edges(), closing);
    borders.insert(borders.end(), own.begin(), own.end());
  }
  for (const HorizonSegment& e : borders) EXPECT_EQ(e.role, EdgeRole::underside);
  compare_for_a_box(bodies, borders, box_edge_m, random, count,
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
