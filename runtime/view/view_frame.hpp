// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/angle.hpp"
#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The local frame in which a city is drawn: metres, x grid east and y grid north of the package's CRS, z up, counted from a
/// place amid the city, so that floats are exact enough. And how the grid lies in it.
struct ViewFrame {
  Point3d origin_projected;  ///< its height is above sea level
  Angle grid_bearing;        ///< of the grid's y axis, clockwise from grid north
  Angle convergence;         ///< true azimuth = grid azimuth + convergence
  double cell_edge_m = 0.0;
  CellRectangle cells;
  Point2d corner_local;                      ///< the south-west corner of the first cell
  double low_local = 0.0, high_local = 0.0;  ///< around the heights of all geometry

  [[nodiscard]] Point3d local_from_projected(const Point3d& p) const { return p - origin_projected; }
  [[nodiscard]] Point3d projected_from_local(const Point3d& p) const { return p + origin_projected; }
  /// Metres along the axes of the grid, from the first cell's corner.
  [[nodiscard]] Point2d grid_from_local(Point2d p_local) const {
    const Point2d p = p_local - corner_local;
    return {dot(p, x_axis()), dot(p, y_axis())};
  }
  [[nodiscard]] Point2d local_from_grid(Point2d p_grid) const { return corner_local + p_grid.x * x_axis() + p_grid.y * y_axis(); }
  [[nodiscard]] Point2d x_axis() const { return {cos(grid_bearing), -sin(grid_bearing)}; }
  [[nodiscard]] Point2d y_axis() const { return {sin(grid_bearing), cos(grid_bearing)}; }
};

/// Throws PackageUnusable, PackageDamaged.
[[nodiscard]] ViewFrame view_frame_of(const Package& package);

}  // namespace farlod
