// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod {

/// A point of a wall: how far along its line in the plan, and how high.
struct WallPoint {
  double along_m = 0.0, z_m = 0.0;
};

/// An upright facet without holes that each upright line meets in one piece. Its borders run along it in ascending order; where
/// they step, two of their points lie one above the other.
struct WallProfile {
  Point2d begin, direction;  ///< grid frame; `direction` has length 1
  double length_m = 0.0;
  std::vector<WallPoint> lower, upper;

  [[nodiscard]] Point2d place(double along_m) const { return begin + along_m * direction; }
  /// Of several heights at a step, the higher one of the lower border and the lower one of the upper border.
  [[nodiscard]] double lower_m(double along_m) const;
  [[nodiscard]] double upper_m(double along_m) const;
};

/// The profile of a ring; none where it is not upright, or where upright lines meet it in several pieces.
[[nodiscard]] std::optional<WallProfile> wall_profile(std::span<const Point3d> ring_grid);

/// The height of the ground at a place.
using GroundHeightAt = std::function<double(Point2d p_grid)>;

/// The walls of a building that reach down to the ground, all along their lower border, or down to the upper border of another
/// one that does. Below their upper borders everything is hidden, whatever else overhangs.
class GroundedWalls {
 public:
  GroundedWalls(std::vector<WallProfile> walls, const GroundHeightAt& ground_height);

  /// Whether the segment runs along the upper border of a grounded wall, or below it.
  [[nodiscard]] bool close_below(const Segment3d& segment) const;

 private:
  [[nodiscard]] bool reach_up_to(Point2d p, double z_m) const;

  std::vector<WallProfile> grounded_;
};

}  // namespace farlod
