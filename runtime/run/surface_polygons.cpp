// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "farlod/inspection.hpp"

namespace farlod {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Ring = std::vector<std::uint32_t>;  ///< vertices, the first not repeated

/// Floats of a cell of 10 km are a millimetre apart, and nobody surveys one.
constexpr double weld_tolerance_m = 1e-3;

/// The vertices of a surface. Those that are one, but for the rounding of two cells, become one again.
class WeldedVertices {
 public:
  std::uint32_t number_of(const Point3d& p) {
    const Point3d reach{weld_tolerance_m, weld_tolerance_m, weld_tolerance_m};
    const Bucket low = bucket_of(p - reach), high = bucket_of(p + reach);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          if (const auto vertex = found_in({x, y, z}, p)) return *vertex;
    const auto vertex = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(p);
    by_bucket_.emplace(bucket_of(p), vertex);
    return vertex;
  }
  [[nodiscard]] const Point3d& at(std::uint32_t vertex) const { return vertices_[vertex]; }

 private:
  static constexpr double bucket_m = 0.01;
  using Bucket = std::array<std::int64_t, 3>;

  [[nodiscard]] static Bucket bucket_of(const Point3d& p) {
    const auto of = [](double x) { return static_cast<std::int64_t>(std::floor(x / bucket_m)); };
    return {of(p.x), of(p.y), of(p.z)};
  }
  [[nodiscard]] std::optional<std::uint32_t> found_in(const Bucket& bucket, const Point3d& p) const {
    const auto [begin, end] = by_bucket_.equal_range(bucket);
    const auto near = std::find_if(begin, end, [&](const auto& v) { return norm(vertices_[v.second] - p) <= weld_tolerance_m; });
    return near == end ? std::nullopt : std::optional(near->second);
  }

  std::vector<Point3d> vertices_;
  std::multimap<Bucket, std::uint32_t> by_bucket_;
};

/// The sides of the triangles that no other triangle has the other way round: the outline of what they cover. By their first
/// vertex.
std::multimap<std::uint32_t, std::uint32_t> outline_of(std::span<const Corners> triangles) {
  std::multimap<std::uint32_t, std::uint32_t> sides;
  for (const Corners& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const auto [begin, end] = sides.equal_range(b);
      const auto other = std::find_if(begin, end, [a](const auto& side) { return side.second == a; });
      if (other != end)
        sides.erase(other);
      else
        sides.emplace(a, b);
    }
  return sides;
}

/// Walks along the sides, ring by ring. A ring ends where it meets itself, so that none touches itself.
std::vector<Ring> rings_of(std::multimap<std::uint32_t, std::uint32_t> sides) {
  std::vector<Ring> rings;
  Ring path;
  while (!sides.empty()) {
    if (path.empty()) path.push_back(sides.begin()->first);
    const auto side = sides.find(path.back());
    // Each vertex has as many sides that end as sides that begin, since triangles do
    if (side == sides.end()) break;
    const std::uint32_t next = side->second;
    sides.erase(side);
    const auto met = std::find(path.begin(), path.end(), next);
    if (met == path.end()) {
      path.push_back(next);
      continue;
    }
    if (path.end() - met >= 3) rings.emplace_back(met, path.end());
    path.erase(met + 1, path.end());
    if (path.size() == 1) path.clear();
  }
  return rings;
}

/// Twice the area of a ring as a vector along its normal (Newell).
template <class Vertices>
Point3d double_area_of(const Vertices& ring, const WeldedVertices& vertices) {
  Point3d sum{};
  const Point3d origin = vertices.at(ring[0]);
  for (std::size_t k = 0; k < ring.size(); ++k)
    sum = sum + cross(vertices.at(ring[k]) - origin, vertices.at(ring[(k + 1) % ring.size()]) - origin);
  return sum;
}

/// Triangles that were cut away to nothing leave rings along both of their long sides.
bool is_sliver(const Ring& ring, const WeldedVertices& vertices) {
  double length_m = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) length_m += norm(vertices.at(ring[(k + 1) % ring.size()]) - vertices.at(ring[k]));
  return norm(double_area_of(ring, vertices)) < weld_tolerance_m * length_m;
}

/// The plane of two coordinates in which a normal is seen best.
class FlatView {
 public:
  explicit FlatView(const Point3d& normal) {
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    dropped_ = z >= x && z >= y ? 2 : x >= y ? 0 : 1;
  }
  [[nodiscard]] Point2d of(const Point3d& p) const {
    return dropped_ == 2 ? Point2d{p.x, p.y} : dropped_ == 0 ? Point2d{p.y, p.z} : Point2d{p.z, p.x};
  }

 private:
  int dropped_ = 2;
};

/// Whether a ring runs around a place: an odd number of its sides crosses the ray to the right of it.
bool surrounds(const std::vector<Point3d>& ring, Point2d p, const FlatView& view) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d a = view.of(ring[k]), b = view.of(ring[(k + 1) % ring.size()]);
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

template <class Vertices>
std::vector<Point3d> places_of(const Vertices& ring, const WeldedVertices& vertices) {
  std::vector<Point3d> places;
  for (const std::uint32_t vertex : ring) places.push_back(vertices.at(vertex));
  return places;
}

/// Gives each hole to the first shell that surrounds it. Rounding may move a hole that touches its shell out of it.
void add_holes(const std::vector<Ring>& holes, const WeldedVertices& vertices, const FlatView& view,
               std::vector<SurfacePolygon>& polygons) {
  for (const Ring& hole : holes) {
    const Point2d place = view.of(vertices.at(hole.front()));
    const auto owner = std::ranges::find_if(polygons, [&](const SurfacePolygon& p) { return surrounds(p.shell, place, view); });
    (owner != polygons.end() ? *owner : polygons.front()).holes.push_back(places_of(hole, vertices));
  }
}

/// The triangles of a surface by the numbers of their vertices, with the sums of their areas; areas are twice as large.
struct WeldedSurface {
  WeldedVertices vertices;
  std::vector<Corners> triangles;
  Point3d normal{};
  double area_m2 = 0.0;

  explicit WeldedSurface(std::span<const std::array<Point3d, 3>> of) {
    for (const auto& [p, q, r] : of) {
      const Corners t{vertices.number_of(p), vertices.number_of(q), vertices.number_of(r)};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      triangles.push_back(t);
      const Point3d double_area = double_area_of(t, vertices);
      normal = normal + double_area;
      area_m2 += norm(double_area);
    }
  }
};

/// The polygons within the outline of a surface. None where they do not make up the area of its triangles: those lie on each
/// other, or not in a plane.
std::vector<SurfacePolygon> polygons_within_outline(const WeldedSurface& surface) {
  std::vector<SurfacePolygon> polygons;
  std::vector<Ring> holes;
  double area_m2 = 0.0;
  for (const Ring& ring : rings_of(outline_of(surface.triangles))) {
    if (is_sliver(ring, surface.vertices)) continue;
    const Point3d double_area = double_area_of(ring, surface.vertices);
    const bool is_hole = dot(double_area, surface.normal) < 0.0;
    area_m2 += (is_hole ? -1.0 : 1.0) * norm(double_area);
    if (is_hole)
      holes.push_back(ring);
    else
      polygons.push_back({places_of(ring, surface.vertices), {}});
  }
  constexpr double share = 0.01, smallest_m2 = 0.01;
  if (std::abs(area_m2 - surface.area_m2) > std::max(share * surface.area_m2, smallest_m2)) return {};
  if (!polygons.empty()) add_holes(holes, surface.vertices, FlatView(surface.normal), polygons);
  return polygons;
}

}  // namespace

std::vector<SurfacePolygon> polygons_of(std::span<const std::array<Point3d, 3>> triangles) {
  const WeldedSurface surface(triangles);
  std::vector<SurfacePolygon> polygons = polygons_within_outline(surface);
  if (!polygons.empty()) return polygons;
  for (const Corners& t : surface.triangles) polygons.push_back({places_of(t, surface.vertices), {}});
  if (!polygons.empty()) return polygons;
  for (const auto& t : triangles) polygons.push_back({{t.begin(), t.end()}, {}});
  return polygons;
}

}  // namespace farlod
