// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {

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

}  // namespace farlod
