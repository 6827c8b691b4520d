// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/point.hpp"

namespace farlod {

/// Lays the points of a facet into a plane and back.
class FacetProjection {
 public:
  /// Drops the coordinate along which the facet is seen largest: no arithmetic, so nothing is rounded. Of a planar facet this is
  /// its own plane, only stretched: rings cross, touch and surround each other in one as they do in the other.
  [[nodiscard]] static FacetProjection dropping_a_coordinate(const Point3d& normal);
  /// Perpendicular onto the plane through `origin`, for facets that are not planar: there, dropping a coordinate may let rings
  /// cross that do not cross when one looks along the normal.
  [[nodiscard]] static FacetProjection onto_plane(const Point3d& origin, const Point3d& normal);

  [[nodiscard]] Point2d operator()(const Point3d& p) const;
  /// The point of the plane through `origin` with the projection's normal that projects to `q`.
  [[nodiscard]] Point3d lift(Point2d q, const Point3d& origin) const;
  /// What runs counter-clockwise about the normal runs clockwise in the plane.
  [[nodiscard]] bool is_mirrored() const { return is_mirrored_; }

 private:
  enum class Way { without_x, without_y, without_z, perpendicular };

  Way way_ = Way::without_z;
  bool is_mirrored_ = false;
  Point3d normal_, origin_, u_, v_;
};

}  // namespace farlod
