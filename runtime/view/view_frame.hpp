// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "farlod/angle.hpp"
#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The axes of a grid in the local frame, of length 1.
struct GridAxes {
  Angle bearing;  ///< of y, clockwise from grid north
  Point2d x{1.0, 0.0}, y{0.0, 1.0};

  static GridAxes turned_by(Angle bearing) { return {bearing, {cos(bearing), -sin(bearing)}, {sin(bearing), cos(bearing)}}; }
};

/// The local frame in which a city is drawn: metres, x grid east and y grid north of the package's CRS, z up, counted from a
/// place amid the city, so that floats are exact enough. And how the grid lies in it.
struct ViewFrame {
  Point3d origin_projected;  ///< its height is above sea level
  GridAxes grid_axes;
  Angle convergence;  ///< true azimuth = grid azimuth + convergence
  double cell_edge_m = 0.0;
  CellRectangle cells;
  Point2d corner_local;                      ///< the south-west corner of the first cell
  double low_local = 0.0, high_local = 0.0;  ///< around the heights of all geometry

  [[nodiscard]] Point3d local_from_projected(const Point3d& p) const { return p - origin_projected; }
  [[nodiscard]] Point3d projected_from_local(const Point3d& p) const { return p + origin_projected; }
  /// Metres along the axes of the grid, from the first cell's corner.
  [[nodiscard]] Point2d grid_from_local(Point2d p_local) const {
    const Point2d p = p_local - corner_local;
    return {dot(p, grid_axes.x), dot(p, grid_axes.y)};
  }
  [[nodiscard]] Point2d local_from_grid(Point2d p_grid) const {
    return corner_local + p_grid.x * grid_axes.x + p_grid.y * grid_axes.y;
  }
};

/// Throws PackageUnusable, PackageDamaged.
[[nodiscard]] ViewFrame view_frame_of(const Package& package);

/// How a city is placed on the globe: the matrix that takes local metres to earth-centred ones (WGS 84), column by column. The
/// unit matrix where the CRS is not known.
using EcefFromLocal = std::array<double, 16>;

/// Turned, moved and enlarged alike in all directions, as viewers of 3D Tiles expect it: the axes of `east` and `north`, which
/// are steps of a metre of the map, with the mean of their lengths. Where they are not at right angles, as of a map that is not
/// conformal, both are turned by the same angle.
[[nodiscard]] EcefFromLocal similar_frame(const Point3d& east, const Point3d& north, const Point3d& origin);

/// Where the local frame is on the globe: the tangent of the map at its origin, so that a metre of the map is as long as it is
/// there; heights are enlarged alike, by up to 1 mm a metre in a zone of UTM. They count from the ellipsoid, since the
/// package does not say how far its zero is from it. Needs GDAL; the unit matrix where the CRS is not known, and without GDAL.
[[nodiscard]] EcefFromLocal placed_on_globe(const PackageDescription& description, const ViewFrame& frame);

}  // namespace farlod
