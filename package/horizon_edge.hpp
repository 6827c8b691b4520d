// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The angles at which the solid rises away from an edge: at right angles to the edge, to the left and to the right of the way
/// from its first end to its second, seen from above. In 127ths of a right angle, rounded down (of lower borders, up).
struct AdjacentSlopes {
  static constexpr std::int8_t straight_down = -127;  ///< a wall, or unknown: it hides nothing of the edge
  static constexpr std::int8_t straight_up = 127;     ///< the same for the lower border of something
  std::int8_t left = straight_down, right = straight_down;
  bool operator==(const AdjacentSlopes&) const = default;

  [[nodiscard]] static std::int8_t rounded_down(double rise_rad) {
    const double steps = std::floor(rise_rad / (0.5 * std::numbers::pi) * 127.0);
    return static_cast<std::int8_t>(std::clamp(steps, -127.0, 127.0));
  }
  [[nodiscard]] static std::int8_t rounded_up(double rise_rad) {
    const double steps = std::ceil(rise_rad / (0.5 * std::numbers::pi) * 127.0);
    return static_cast<std::int8_t>(std::clamp(steps, -127.0, 127.0));
  }
  /// The tangent of the angle; beyond all slopes of a city where that is straight down or up.
  [[nodiscard]] static double slope(std::int8_t rise) {
    static const std::array<double, 255> slopes = [] {
      std::array<double, 255> all{};
      for (int steps = -127; steps <= 127; ++steps)
        all[static_cast<std::size_t>(steps + 127)] = std::tan(0.5 * std::numbers::pi / 127.0 * steps);
      return all;
    }();
    return slopes[static_cast<std::size_t>(std::max<int>(rise, -127) + 127)];
  }
};

/// A facet that leans out by no more than this over its height, an error of surveys, counts as vertical: no lower border tells
/// that sky may be seen below its top. Its receivers therefore stand ahead of its top; other eyes right below it count as in a
/// recess.
inline constexpr double max_lean_m = 0.05;

/// A grounded border may lie over a recess, such as a window set back. It hides all below it for all eyes but those in the
/// recess. These see it from below its facets, at most so far away in the plan at right angles to the border.
inline constexpr double most_recess_depth_m = 1.0;
/// The largest distance of two places of a recess in the plan.
inline constexpr double most_recess_extent_m = 4.0;

/// What an edge says about the sky below it. In the upright half-plane of an azimuth, a connected piece of the city hides all
/// slopes between its lowest and its highest one. Proof and use: docs/concepts.md, "What is grounded, and what overhangs".
enum class EdgeRole : std::uint16_t {
  grounded = 0,   ///< an upper border: everything below it is hidden, down to the ground
  overhang = 1,   ///< an upper border of something that may be seen under
  underside = 2,  ///< a lower border of such a thing: sky may be seen below it
};
inline constexpr std::size_t edge_role_count = 3;

/// An edge of the city that can be a silhouette. The upper envelope of `grounded` and `overhang` edges is a receiver's horizon;
/// above the upper envelope of the `underside` edges, nothing floats.
/// `adjacent` is that of the steepest facets beside an upper border, and of the flattest ones beside a lower border; there,
/// AdjacentSlopes::straight_up stands for a wall or for none.
struct HorizonEdge {
  Point3f a, b;
  AdjacentSlopes adjacent{};
  EdgeRole role = EdgeRole::grounded;
  bool operator==(const HorizonEdge&) const = default;
};
static_assert(sizeof(HorizonEdge) == 28);

/// Eyes this near to the plane of a facet count as being on either side of it: twice the rounding of a place 4 km from the
/// origin.
inline constexpr double facing_slack_m = 0.001;

/// Whether an upper border can be a horizon for some eye in a box, as far as the facets beside it tell: not if each eye looks at
/// it through the solid, or sees the solid rise behind it. And whether a lower border can be a lower silhouette: not if for each
/// eye a facet beside it reaches lower. Proof in docs/concepts.md, "Edges that face away".
[[nodiscard]] inline bool may_be_silhouette(const Point3d& a, const Point3d& b, AdjacentSlopes adjacent, EdgeRole role,
                                            const Box2d& eyes_plan, double eyes_low_m, double eyes_high_m) {
  const Point3d along = b - a;
  // Not std::hypot: nothing here is near the limits of a double, and this is asked of each edge that a far map meets
  const double run_m = std::sqrt(dot(horizontal(along), horizontal(along))),
               length_m = std::sqrt(run_m * run_m + along.z * along.z);
  if (run_m == 0.0) return true;
  const std::array corners{eyes_plan.low, Point2d{eyes_plan.high.x, eyes_plan.low.y}, eyes_plan.high,
                           Point2d{eyes_plan.low.x, eyes_plan.high.y}};
  double least_left_m = std::numeric_limits<double>::infinity(), most_left_m = -least_left_m;
  for (const Point2d corner : corners) {
    const Point2d v = corner - horizontal(a);
    const double left_m = (along.x * v.y - along.y * v.x) / run_m;
    least_left_m = std::min(least_left_m, left_m);
    most_left_m = std::max(most_left_m, left_m);
  }
  if (least_left_m <= facing_slack_m && most_left_m >= -facing_slack_m) return true;
  const bool eyes_left = least_left_m > 0.0, is_upper = role != EdgeRole::underside;
  const double near_slope = AdjacentSlopes::slope(eyes_left ? adjacent.left : adjacent.right),
               far_slope = AdjacentSlopes::slope(eyes_left ? adjacent.right : adjacent.left);
  // No eye above the edge has it above the level
  const double highest_eye_m = std::min(eyes_high_m, std::max(a.z, b.z) - 2.0 * facing_slack_m);
  bool near_lets_see = false, far_lets_see = false;
  for (const Point2d corner : corners) {
    const Point2d v = corner - horizontal(a);
    const double aside_m = std::abs(along.x * v.y - along.y * v.x) / run_m, ahead_m = dot(horizontal(along), v) / run_m;
    const auto rise_m = [&](double z_m) { return ((z_m - a.z) * run_m - ahead_m * along.z) / length_m; };
    const double lowest_rise_m = rise_m(eyes_low_m), highest_rise_m = rise_m(highest_eye_m);
    if (is_upper) {
      near_lets_see = near_lets_see || highest_rise_m > aside_m * near_slope - facing_slack_m;
      far_lets_see = far_lets_see || lowest_rise_m < -aside_m * far_slope + facing_slack_m;
    } else {
      near_lets_see = near_lets_see || lowest_rise_m < aside_m * near_slope + facing_slack_m;
      far_lets_see = far_lets_see || highest_rise_m > -aside_m * far_slope - facing_slack_m;
    }
  }
  return near_lets_see && far_lets_see;
}

/// The plane through an eye and an edge. Along the azimuth of the unit vector u, it rises from the eye by
/// slope(u) = along_x·u.x + along_y·u.y: the tangent of the elevation, linear in the cosine and the sine of the azimuth.
struct SlopePlane {
  double along_x = 0.0, along_y = 0.0;
  [[nodiscard]] double slope(Point2d u) const { return along_x * u.x + along_y * u.y; }
};

/// An edge as an eye sees it: its ends relative to the eye.
struct EdgeView {
  Point3d a, b;

  /// Twice the signed area of the triangle that the eye spans with the edge, seen from above: positive when the edge runs
  /// counter-clockwise around the eye, zero when the eye looks along it.
  [[nodiscard]] double turn() const { return a.x * b.y - a.y * b.x; }
  /// `turn()` must not be zero.
  [[nodiscard]] SlopePlane plane() const {
    const Point3d normal = cross(a, b);
    return {-normal.x / normal.z, -normal.y / normal.z};
  }
};

}  // namespace farlod
