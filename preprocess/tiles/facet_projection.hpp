// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/point.hpp"

namespace farlod::tiles {

/// Projects the points of a facet onto a plane, and back.
class FacetProjection {
 public:
  /// Drops the coordinate with the largest component of the normal. No arithmetic is done, so nothing is rounded. For a planar
  /// facet this is an affine map of its own plane: rings cross, touch and surround each other in both alike.
  [[nodiscard]] static FacetProjection dropping_a_coordinate(const Point3d& normal);
  /// Projects along the normal onto the plane through `origin`. For facets that are not planar: if a coordinate is dropped, rings
  /// may cross that do not cross along the normal.
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

}  // namespace farlod::tiles
