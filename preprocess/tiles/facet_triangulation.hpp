// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/mesh_view.hpp"
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

/// The triangles of a facet.
struct Triangulation {
  std::vector<Point3d> points;  ///< the points of all rings, one ring after the other, then those where rings cross
  std::vector<Triangle> triangles;
  bool rings_cross = false;  ///< the rings touch or cross each other; what lies inside was decided by even and odd
};

/// Area vector of closed rings (Newell): half the sum of the cross products of neighboring points, taken from the first point so
/// that large coordinates do not cancel. The first ring counts as drawn; each other ring counts as a hole.
[[nodiscard]] Point3d area_vector(std::span<const std::span<const Point3d>> rings);

/// Triangulates a facet with holes. For every facet whose rings do not cross:
///   (1) The corners of the triangles are the facet's points, unchanged, so that the exact area vectors of the triangles sum to
///       the area vector of the facet.
///   (2) The triangles have the orientation of the outer ring.
///   (3) A facet without area has no triangles.
/// Where rings cross, in the facet's own plane, the inside is where an odd number of rings surrounds it.
[[nodiscard]] Triangulation triangulate(std::span<const std::span<const Point3d>> rings);

/// Sum of the triangles' area vectors: the facet's own, but where rings cross, for there it says what was kept.
[[nodiscard]] Point3d area_vector(const Triangulation& triangulation);

/// Largest distance of a facet's points from the plane through its first point along `unit_normal`.
[[nodiscard]] double distance_from_plane_m(std::span<const std::span<const Point3d>> rings, const Point3d& unit_normal);

}  // namespace farlod::tiles
