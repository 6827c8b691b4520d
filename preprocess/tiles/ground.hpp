// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The ground: a triangulated irregular network (Delaunay in the plane) through points of known height, over a rectangle of the grid
/// frame that it covers whole.
///   (1) of points one above the other, the lowest counts
///   (2) the corners of the rectangle have the height of the nearest point
///   (3) the same points in another order give the same ground
class Ground {
 public:
  /// `points_grid` may lie anywhere; those outside of the rectangle shape the ground at its edge. None: flat at height 0.
  Ground(std::vector<Point3d> points_grid, const Box2d& rectangle);
  Ground(Ground&&) noexcept;
  Ground& operator=(Ground&&) noexcept;
  ~Ground();

  /// Height of the ground; the point must lie within the rectangle. Not for several threads at once.
  [[nodiscard]] double height_at(Point2d p_grid) const;
  /// All triangles, counter-clockwise seen from above, in a fixed order.
  [[nodiscard]] std::vector<std::array<Point3d, 3>> triangles() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
