// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod {

/// How far the ground reaches.
enum class GroundExtent {
  rectangle,  ///< over the whole rectangle: where the points do not reach its corners, these get the height of the nearest
  points      ///< no farther than the points themselves: beyond them nothing is known
};

/// The ground: a triangulated irregular network (Delaunay in the plane) through points of known height.
///   (1) of points one above the other, the lowest counts
///   (2) it covers the rectangle whole, or the convex hull of its points, as its extent says
///   (3) the same points in another order give the same ground
class Ground {
 public:
  /// `points_grid` may lie anywhere; those outside of the rectangle shape the ground at its edge. None: flat at height 0.
  Ground(std::vector<Point3d> points_grid, const Box2d& rectangle, GroundExtent extent = GroundExtent::rectangle);
  Ground(Ground&&) noexcept;
  Ground& operator=(Ground&&) noexcept;
  ~Ground();

  /// Height of the ground; beyond it, that of the nearest point. Not for several threads at once.
  [[nodiscard]] double height_at(Point2d p_grid) const;
  /// All triangles, counter-clockwise seen from above, in a fixed order.
  [[nodiscard]] std::vector<std::array<Point3d, 3>> triangles() const;
  /// Edges of the triangles that can be a horizon: the convex ones and the border, in a fixed order.
  [[nodiscard]] std::vector<HorizonSegment> horizon_edges() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
