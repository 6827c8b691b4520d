// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "farlod/box.hpp"
#include "package/edge_facing.hpp"
#include "tests/preprocess/tiles/bodies.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles::test {

/// A place within this many metres of the origin is rounded by a few times this.
inline constexpr double reach_m = 128.0;
inline constexpr double rounding_m = 8 * reach_m * std::numeric_limits<double>::epsilon();

/// A convex body, each face convex and seen counter-clockwise from outside.
using Body = std::vector<Face>;

inline bool is_inside(const Body& body, const Point3d& p) {
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
struct Highest {
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

}  // namespace farlod::tiles::test
