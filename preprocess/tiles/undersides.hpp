// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "tiles/ground.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

/// A point of a wall: its distance along the wall's line in plan, and its height.
struct WallPoint {
  double along_m = 0.0, z_m = 0.0;
};

/// A vertical facet without holes whose intersection with any vertical line is connected. The points of both borders are sorted
/// along the wall. Where a border has a step, two of its points have the same distance along the wall.
struct WallProfile {
  Point2d begin, direction;  ///< grid frame; `direction` has length 1
  double length_m = 0.0;
  std::vector<WallPoint> lower, upper;

  [[nodiscard]] Point2d place(double along_m) const { return begin + along_m * direction; }
  /// The height of a border. At a step, the higher end of the lower border and the lower end of the upper border.
  [[nodiscard]] double lower_m(double along_m) const;
  [[nodiscard]] double upper_m(double along_m) const;
};

/// The profile of a ring; nothing when the ring is not vertical, or when a vertical line meets it in several pieces.
[[nodiscard]] std::optional<WallProfile> wall_profile(std::span<const Point3d> ring_grid);

/// The grounded walls of a building: the lower border of each lies, along its whole length, on the ground or on the upper border
/// of another grounded wall. A grounded wall hides everything below its upper border, whatever overhangs it.
class GroundedWalls {
 public:
  GroundedWalls(std::vector<WallProfile> walls, const GroundHeightAt& ground_height);

  /// Whether the segment runs along the upper border of a grounded wall, or below it.
  [[nodiscard]] bool close_below(const Segment3d& segment) const;
  [[nodiscard]] std::span<const WallProfile> walls() const { return grounded_; }

 private:
  [[nodiscard]] bool reach_up_to(Point2d p, double z_m) const;

  std::vector<WallProfile> grounded_;
};

/// The parts of lower borders that are above the ground.
[[nodiscard]] std::vector<HorizonSegment> above_ground(const std::vector<HorizonSegment>& undersides, const Ground& ground);

}  // namespace farlod::tiles
