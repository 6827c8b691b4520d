// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/mesh/planar_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <utility>

namespace farlod::ingest {
namespace {

struct Edge {
  std::uint32_t low, high;  ///< welded points
  std::uint32_t face;
  auto key() const { return std::pair((std::uint64_t{low} << 32) | high, face); }
  bool same_place(const Edge& other) const { return low == other.low && high == other.high; }
};

/// Edges with more faces are not used: they do not occur on buildings, and the number of pairs of faces grows with the square.
constexpr std::size_t most_neighbors_at_an_edge = 8;

bool is_finite(std::span<const Point3d> face) {
  return std::all_of(face.begin(), face.end(),
                     [](const Point3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

/// The point of a face that is farthest from a line.
struct Apex {
  Point3d p;
  double distance_m = 0.0;
};

/// The line runs through two points of the face.
Apex apex_over(std::span<const Point3d> face, const Point3d& a, const Point3d& b) {
  const Point3d along = b - a;
  const double length = norm(along);
  const auto at = [&](const Point3d& p) { return Apex{p, length > 0.0 ? norm(cross(along, p - a)) / length : norm(p - a)}; };
  Apex farthest = at(face.front());
  for (const Point3d& p : face.subspan(1))
    if (const Apex other = at(p); farthest.distance_m < other.distance_m) farthest = other;
  return farthest;
}

/// The largest distance by which rounding can move a point off the plane of three others. (λ) are its barycentric coordinates
/// with respect to them. Rounding moves each point by up to half a step along each axis, hence along the unit normal by up to
/// half a step times the 1-norm of the normal. The plane moves at the point by the movements of its corners with the weights λ.
double rounding_bound(const Point3d& unit_normal, const std::array<double, 3>& barycentric) {
  const double one_norm = std::abs(unit_normal.x) + std::abs(unit_normal.y) + std::abs(unit_normal.z);
  return 0.5 * coordinate_rounding_m * one_norm *
         (1.0 + std::abs(barycentric[0]) + std::abs(barycentric[1]) + std::abs(barycentric[2]));
}

bool are_coplanar(std::span<const Point3d> face_1, std::span<const Point3d> face_2, const Point3d& a, const Point3d& b) {
  Apex wide = apex_over(face_1, a, b), narrow = apex_over(face_2, a, b);
  if (wide.distance_m < narrow.distance_m) std::swap(wide, narrow);
  const Point3d u = b - a, v = wide.p - a, w = narrow.p - a;
  const Point3d n = cross(u, v);
  const double nn = dot(n, n);
  if (!(nn > 0.0)) return false;
  const double of_wide = dot(cross(u, w), n) / nn, of_b = dot(cross(w, v), n) / nn;
  const Point3d unit = normalized(n);
  return std::abs(dot(unit, w)) <= rounding_bound(unit, {1.0 - of_b - of_wide, of_b, of_wide});
}

/// The thickness of a face: its extent perpendicular to its longest edge.
double thickness(std::span<const Point3d> face) {
  if (face.empty()) return 0.0;
  double longest = 0.0;
  Point3d begin, end;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Point3d &a = face[i], &b = face[(i + 1) % face.size()];
    const double length = norm(b - a);
    if (length < longest) continue;
    longest = length;
    begin = a;
    end = b;
  }
  return apex_over(face, begin, end).distance_m;
}

/// A triangle thinner than this has no reliable normal. Rounding moves each coordinate by up to half a step, hence a point by up
/// to √3/2 steps. The two points that span the thickness can move in opposite directions.
constexpr double thinnest_face_m = 1.7320508075688772 * coordinate_rounding_m;

class PlanarFaces {
 public:
  explicit PlanarFaces(const FaceCorners& mesh) : mesh_(mesh), sets_(mesh.face_count()), point_of_(weld(mesh.points)) {
    list_edges();
    for (std::size_t f = 0; f < mesh.face_count(); ++f) thin_.push_back(thickness(mesh.face(f)) <= thinnest_face_m);
    for_each_pair([&](const Edge& e, const Edge& other) { join_if_coplanar(e, other); });
    // Thin faces join last, and each joins one neighbor, so that none connects two planar faces
    for_each_pair([&](const Edge& e, const Edge& other) { join_if_thin(e.face, other.face); });
  }

  std::vector<std::uint32_t> numbers() {
    std::vector<std::uint32_t> number_of_set(mesh_.face_count(), unnumbered), numbers;
    std::uint32_t next = 0;
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      std::uint32_t& number = number_of_set[sets_.find(f)];
      if (number == unnumbered) number = next++;
      numbers.push_back(number);
    }
    return numbers;
  }

 private:
  static constexpr std::uint32_t unnumbered = 0xFFFFFFFF;

  void list_edges() {
    a_point_.resize(mesh_.points.size());
    for (std::uint32_t c = 0; c < mesh_.points.size(); ++c) a_point_[point_of_[c]] = mesh_.points[c];
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      if (!is_finite(mesh_.face(f))) continue;  // without a plane it gets no neighbors
      const std::uint32_t begin = mesh_.first_corner[f], end = mesh_.first_corner[f + 1];
      for (std::uint32_t c = begin; c < end; ++c) {
        const std::uint32_t p = point_of_[c], q = point_of_[c + 1 < end ? c + 1 : begin];
        if (p != q) edges_.push_back({std::min(p, q), std::max(p, q), f});
      }
    }
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
  }

  template <class Use>
  void for_each_pair(Use use) {
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (std::size_t j = i + 1; j < edges_.size() && j <= i + most_neighbors_at_an_edge && edges_[i].same_place(edges_[j]); ++j)
        if (edges_[i].face != edges_[j].face) use(edges_[i], edges_[j]);
  }

  void join_if_coplanar(const Edge& e, const Edge& other) {
    if (thin_[e.face] || thin_[other.face]) return;
    if (are_coplanar(mesh_.face(e.face), mesh_.face(other.face), a_point_[e.low], a_point_[e.high]))
      sets_.join(e.face, other.face);
  }

  void join_if_thin(std::uint32_t f, std::uint32_t g) {
    if (!thin_[f] && !thin_[g]) return;
    const std::uint32_t joiner = thin_[f] ? f : g;
    sets_.join(f, g);
    thin_[joiner] = false;
  }

  const FaceCorners& mesh_;
  DisjointSets sets_;
  std::vector<std::uint32_t> point_of_;
  std::vector<Point3d> a_point_;
  std::vector<Edge> edges_;
  std::vector<bool> thin_;
};

/// What std::weak_order says, sooner for numbers. Unlike `<`, it also orders NaN.
std::weak_ordering order_of(double x, double y) {
  if (x < y) return std::weak_ordering::less;
  if (x > y) return std::weak_ordering::greater;
  return x == y ? std::weak_ordering::equivalent : std::weak_order(x, y);
}

}  // namespace

std::vector<std::uint32_t> weld(std::span<const Point3d> points) {
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const Point3d &p = points[i], &q = points[j];
    if (const auto x = order_of(p.x, q.x); x != 0) return x < 0;
    if (const auto y = order_of(p.y, q.y); y != 0) return y < 0;
    return order_of(p.z, q.z) < 0;
  };
  std::vector<std::uint32_t> order(points.size()), number(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), less);
  std::uint32_t next = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k > 0 && less(order[k - 1], order[k])) ++next;
    number[order[k]] = next;
  }
  return number;
}

std::vector<std::uint32_t> number_planar_faces(const FaceCorners& mesh) { return PlanarFaces(mesh).numbers(); }

}  // namespace farlod::ingest
