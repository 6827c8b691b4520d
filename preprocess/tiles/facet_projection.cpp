// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/facet_projection.hpp"

#include <cmath>

namespace farlod::tiles {

FacetProjection FacetProjection::dropping_a_coordinate(const Point3d& normal) {
  FacetProjection p;
  p.normal_ = normal;
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  p.way_ = z >= x && z >= y ? Way::without_z : x >= y ? Way::without_x : Way::without_y;
  p.is_mirrored_ = (p.way_ == Way::without_x ? normal.x : p.way_ == Way::without_y ? normal.y : normal.z) < 0.0;
  return p;
}

FacetProjection FacetProjection::onto_plane(const Point3d& origin, const Point3d& normal) {
  FacetProjection p;
  p.way_ = Way::perpendicular;
  p.normal_ = normalized(normal);
  p.origin_ = origin;
  // Any direction in the plane will do; the one across the steepest slope is far from the normal
  const bool is_upright = std::abs(p.normal_.z) < std::hypot(p.normal_.x, p.normal_.y);
  p.u_ = normalized(cross(is_upright ? Point3d{0.0, 0.0, 1.0} : Point3d{0.0, 1.0, 0.0}, p.normal_));
  p.v_ = cross(p.normal_, p.u_);
  return p;
}

Point2d FacetProjection::operator()(const Point3d& p) const {
  switch (way_) {
    case Way::without_x:
      return {p.y, p.z};
    case Way::without_y:
      return {p.z, p.x};
    case Way::perpendicular:
      return {dot(p - origin_, u_), dot(p - origin_, v_)};
    case Way::without_z:
      break;
  }
  return {p.x, p.y};
}

Point3d FacetProjection::lift(Point2d q, const Point3d& origin) const {
  const Point3d& n = normal_;
  switch (way_) {
    case Way::without_x:
      return {origin.x - (n.y * (q.x - origin.y) + n.z * (q.y - origin.z)) / n.x, q.x, q.y};
    case Way::without_y:
      return {q.y, origin.y - (n.z * (q.x - origin.z) + n.x * (q.y - origin.x)) / n.y, q.x};
    case Way::perpendicular:
      return origin_ + q.x * u_ + q.y * v_;
    case Way::without_z:
      break;
  }
  return {q.x, q.y, origin.z - (n.x * (q.x - origin.x) + n.y * (q.y - origin.y)) / n.z};
}

}  // namespace farlod::tiles
