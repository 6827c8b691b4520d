// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {

/// Two directions that differ by less than this count as one. The rotation into the grid frame rounds a point by less than
/// 1e-10 m (53 bits of a double, a city below 400 km); over `least_extent_m` this gives the angle.
inline constexpr double angle_tolerance_rad = 1e-6;
/// Edges that run less in the plan, and facets that reach less far from their edge, have no direction of their own.
inline constexpr double least_extent_m = 1e-4;

/// The facets beside an edge, as far as an upper border needs them. A side of the edge is left or right of the direction from `a`
/// to `b`, seen from above. The rise of a facet is the angle at which it leaves the edge, measured in the plane at right angles
/// to the edge: 0 is horizontal, positive is upwards. Proof in docs/stages/tiles.md, "Horizon edges".
class UpperFacets {
 public:
  /// Where a facet leads from its edge.
  struct Facet {
    double aside_m;   ///< of its third corner in the plan, positive to the left
    double rise_m;    ///< of that corner above the edge, at right angles to the edge in its vertical plane
    double rise_rad;  ///< the rise
  };

  /// Adds a facet of the edge from `a` to `b`, given by its third corner, and tells where it leads. Nothing of slivers, whose
  /// planes are decided by rounding: they do not count.
  std::optional<Facet> add(const Point3d& a, const Point3d& b, const Point3d& opposite) {
    const Point3d along = b - a, v = opposite - a;
    const double run_m = norm(horizontal(along)), length_m = norm(along);
    if (run_m < least_extent_m || norm(cross(along, v)) < least_extent_m * length_m) return std::nullopt;
    const double aside_m = (along.x * v.y - along.y * v.x) / run_m;
    const double ahead_m = dot(horizontal(along), horizontal(v)) / run_m;
    const double rise_m = (v.z * run_m - ahead_m * along.z) / length_m;
    const Facet facet{aside_m, rise_m, std::atan2(rise_m, std::abs(aside_m))};
    // A vertical facet hides the edge when it rises, and has no effect when it lies below
    if (std::abs(aside_m) <= angle_tolerance_rad * std::abs(rise_m)) {
      under_wall_ |= rise_m > 0.0;
      return facet;
    }
    double& side_rad = aside_m > 0.0 ? left_rad_ : right_rad_;
    side_rad = std::max(side_rad, facet.rise_rad);
    return facet;
  }

  /// False: from every eye, one of the facets reaches at least as high as the edge wherever the edge is seen.
  [[nodiscard]] bool can_be_horizon(const Point3d& a, const Point3d& b) const {
    if (norm(horizontal(b - a)) <= upright_m || under_wall_) return false;
    // The highest facets on both sides bend downwards: the edge is convex
    return left_rad_ + right_rad_ < -angle_tolerance_rad;
  }
  [[nodiscard]] AdjacentSlopes adjacent() const {
    return {AdjacentSlopes::rounded_down(left_rad_), AdjacentSlopes::rounded_down(right_rad_)};
  }

 private:
  /// An edge with a shorter horizontal run than this is vertical: the rounding to the floats of a tile moves its ends farther.
  static constexpr double upright_m = 1e-6;

  bool under_wall_ = false;  ///< a vertical facet rises from the edge
  /// The largest rise on either side; -infinity without a facet.
  double left_rad_ = -std::numeric_limits<double>::infinity(), right_rad_ = -std::numeric_limits<double>::infinity();
};

}  // namespace farlod
