// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "contract/ground_contact.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

/// The area that the ground covers.
enum class GroundExtent {
  rectangle,  ///< the whole rectangle: a corner beyond the points gets the height of the nearest point
  points      ///< the convex hull of the points: nothing is known beyond it
};

/// The height of the ground at a place.
using GroundHeightAt = std::function<double(Point2d p_grid)>;

/// The largest distance between two places of a border at which its height is compared with the ground.
inline constexpr double ground_sampling_step_m = 1.0;
/// The number of intervals into which a border of this horizontal length is divided by such places.
[[nodiscard]] inline int ground_sampling_intervals(double run_m) {
  return static_cast<int>(std::ceil(std::max(1.0, run_m / ground_sampling_step_m)));
}

/// The ground: a triangulated irregular network (Delaunay in the plane) through points of known height.
///   (1) Of several points at one place in the plane, the lowest counts.
///   (2) It covers the rectangle, or the convex hull of its points, according to its extent.
///   (3) It does not depend on the order of the points.
class Ground {
 public:
  /// Points outside of the rectangle shape the ground at its edge. Without points the ground is flat at height 0.
  Ground(std::vector<Point3d> points_grid, const Box2d& rectangle, GroundExtent extent = GroundExtent::rectangle);
  Ground(Ground&&) noexcept;
  Ground& operator=(Ground&&) noexcept;
  ~Ground();

  /// Height of the ground; beyond it, the height of the nearest point. Not thread-safe.
  [[nodiscard]] double height_at(Point2d p_grid) const;
  /// All triangles, counter-clockwise seen from above, in a fixed order.
  [[nodiscard]] std::vector<std::array<Point3d, 3>> triangles() const;
  /// Edges of the triangles that can be a horizon: the convex ones and the border, in a fixed order.
  [[nodiscard]] std::vector<HorizonSegment> horizon_edges() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod::tiles
