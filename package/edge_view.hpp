// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/point.hpp"

namespace farlod {

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
