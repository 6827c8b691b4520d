// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <utility>

#include "tiles/facet_triangulation.hpp"

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

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
constexpr std::uint32_t no_number = 0xFFFFFFFF;

struct PointNumber {
  std::uint32_t value = no_number;
};
enum class Side : std::uint8_t { unvisited, outside, inside };
struct FaceSide {
  Side value = Side::unvisited;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<PointNumber, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<FaceSide, Kernel>>;
using DataStructure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, DataStructure, CGAL::Exact_predicates_tag>;
/// Knows how many rings run along an edge, so that a keyhole's bridge (drawn there and back) bounds nothing.
using Rings = CGAL::Constrained_triangulation_plus_2<Delaunay>;

/// A facet whose points are nearer to its plane than this counts as planar: files round to millimetres.
constexpr double bent_m = 0.001;

Kernel::Point_2 flat(const Point3d& p, const FacetProjection& project) {
  const Point2d q = project(p);
  return {q.x, q.y};
}

/// Splits a convex ring of up to four points into a fan: most walls and all triangles. False for other rings.
bool add_convex_fan(Triangulation& result, const FacetProjection& project) {
  const std::size_t n = result.points.size();
  if (n > 4) return false;
  const CGAL::Orientation wanted = project.is_mirrored() ? CGAL::CLOCKWISE : CGAL::COUNTERCLOCKWISE;
  for (std::size_t k = 0; k < n; ++k) {
    const auto turn = CGAL::orientation(flat(result.points[k], project), flat(result.points[(k + 1) % n], project),
                                        flat(result.points[(k + 2) % n], project));
    if (turn != wanted) return false;
  }
  result.triangles.reserve(n - 2);
  for (std::uint32_t k = 2; k < n; ++k) result.triangles.push_back({0, k - 1, k});
  return true;
}

/// Inserts the rings as constraints into the triangulation, and numbers their vertices as in `points`.
void draw(Rings& plane, std::span<const std::span<const Point3d>> rings, const FacetProjection& project) {
  std::uint32_t number = 0;
  std::vector<Rings::Vertex_handle> corners;
  for (const auto ring : rings) {
    corners.clear();
    for (const Point3d& p : ring) {
      const auto corner = plane.insert(flat(p, project));
      if (corner->info().value == no_number) corner->info().value = number;
      ++number;
      corners.push_back(corner);
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto a = corners[k], b = corners[(k + 1) % corners.size()];
      if (a != b) plane.insert_constraint(a, b);
    }
  }
}

/// Whether the edge separates inside from outside: an odd number of rings runs along it.
bool is_border(const Rings& plane, const Rings::Face_handle& face, int edge) {
  if (!face->is_constrained(edge)) return false;
  return plane.number_of_enclosing_constraints(face->vertex(plane.cw(edge)), face->vertex(plane.ccw(edge))) % 2 == 1;
}

/// Marks all faces as inside or outside, by breadth-first search from the infinite face, which is outside.
void mark_sides(Rings& plane) {
  std::deque<Rings::Face_handle> open{plane.infinite_face()};
  open.front()->info().value = Side::outside;
  while (!open.empty()) {
    const auto face = open.front();
    open.pop_front();
    for (int edge = 0; edge < 3; ++edge) {
      const auto next = face->neighbor(edge);
      if (next->info().value != Side::unvisited) continue;
      const bool inside = (face->info().value == Side::inside) != is_border(plane, face, edge);
      next->info().value = inside ? Side::inside : Side::outside;
      open.push_back(next);
    }
  }
}

/// Numbers the vertices that CGAL inserted where rings cross, and lifts them into the facet's plane.
void number_crossings(Rings& plane, Triangulation& result, const FacetProjection& project) {
  for (auto v = plane.finite_vertices_begin(); v != plane.finite_vertices_end(); ++v) {
    if (v->info().value != no_number) continue;
    v->info().value = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back(project.lift({v->point().x(), v->point().y()}, result.points.front()));
    result.rings_cross = true;
  }
}

void collect_inside(const Rings& plane, Triangulation& result, bool mirrored) {
  for (auto face = plane.finite_faces_begin(); face != plane.finite_faces_end(); ++face) {
    if (face->info().value != Side::inside) continue;
    Triangle t{face->vertex(0)->info().value, face->vertex(1)->info().value, face->vertex(2)->info().value};
    if (mirrored) std::swap(t.b, t.c);
    result.triangles.push_back(t);
  }
}

/// A normal for a facet whose area vector vanishes, as the two wings of a bow tie cancel each other: that of its largest corner
/// triangle.
Point3d normal_of_wings(std::span<const Point3d> ring) {
  Point3d largest;
  for (std::size_t k = 2; k < ring.size(); ++k) {
    const Point3d wing = cross(ring[k - 1] - ring[0], ring[k] - ring[0]);
    if (norm(wing) > norm(largest)) largest = wing;
  }
  return largest;
}

}  // namespace

Point3d area_vector(std::span<const std::span<const Point3d>> rings) {
  Point3d total;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto ring = rings[r];
    Point3d sum;
    for (std::size_t k = 2; k < ring.size(); ++k) sum = sum + 0.5 * cross(ring[k - 1] - ring[0], ring[k] - ring[0]);
    // A hole removes area whatever its orientation, which differs from file to file
    total = r == 0 || dot(sum, total) < 0.0 ? total + sum : total - sum;
  }
  return total;
}

Point3d area_vector(const Triangulation& t) {
  Point3d sum;
  for (const Triangle& c : t.triangles) sum = sum + 0.5 * cross(t.points[c.b] - t.points[c.a], t.points[c.c] - t.points[c.a]);
  return sum;
}

namespace {

Triangulation triangulate_in(const FacetProjection& project, std::span<const std::span<const Point3d>> rings) {
  Triangulation result;
  for (const auto ring : rings) result.points.insert(result.points.end(), ring.begin(), ring.end());
  if (rings.size() == 1 && add_convex_fan(result, project)) return result;
  Rings plane;
  draw(plane, rings, project);
  if (plane.dimension() < 2) return result;
  mark_sides(plane);
  number_crossings(plane, result, project);
  collect_inside(plane, result, project.is_mirrored());
  return result;
}

}  // namespace

Triangulation triangulate(std::span<const std::span<const Point3d>> rings) {
  if (rings.empty() || rings[0].size() < 3) return {};
  Point3d normal = area_vector(rings);
  if (norm(normal) == 0.0) normal = normal_of_wings(rings[0]);
  if (norm(normal) == 0.0) return {};
  Triangulation result = triangulate_in(FacetProjection::dropping_a_coordinate(normal), rings);
  // In a coordinate plane the rings of a bent facet may cross, although they do not in its own plane: try again there
  if (result.rings_cross && distance_from_plane_m(rings, normalized(normal)) > bent_m)
    return triangulate_in(FacetProjection::onto_plane(rings[0][0], normal), rings);
  return result;
}

double distance_from_plane_m(std::span<const std::span<const Point3d>> rings, const Point3d& unit_normal) {
  double largest = 0.0;
  for (const auto ring : rings)
    for (const Point3d& p : ring) largest = std::max(largest, std::abs(dot(p - rings[0][0], unit_normal)));
  return largest;
}

}  // namespace farlod::tiles
