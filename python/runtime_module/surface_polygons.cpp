// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/runtime_module/surface_polygons.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/point.hpp"

namespace farlod {
namespace {

using Ring = std::vector<std::uint32_t>;  ///< vertices, the first not repeated

struct PolygonRings {
  Ring shell;
  std::vector<Ring> holes;
};

/// The sides of the triangles that no other triangle has the other way round: the outline of what they cover. By their first
/// vertex.
std::multimap<std::uint32_t, std::uint32_t> outline_of(std::span<const MeshTriangle> triangles) {
  std::multimap<std::uint32_t, std::uint32_t> sides;
  for (const MeshTriangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t.vertices[k], b = t.vertices[(k + 1) % 3];
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
Point3d area_of(const Ring& ring, std::span<const Point3d> vertices) {
  Point3d sum{};
  for (std::size_t k = 0; k < ring.size(); ++k)
    sum = sum + cross(vertices[ring[k]] - vertices[ring[0]], vertices[ring[(k + 1) % ring.size()]] - vertices[ring[0]]);
  return sum;
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
bool surrounds(const Ring& ring, Point2d p, std::span<const Point3d> vertices, const FlatView& view) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d a = view.of(vertices[ring[k]]), b = view.of(vertices[ring[(k + 1) % ring.size()]]);
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

/// Outlines run counter-clockwise about the normal of the triangles, holes the other way.
std::vector<PolygonRings> polygons_of(std::span<const MeshTriangle> triangles, std::span<const Point3d> vertices) {
  Point3d normal{};
  for (const MeshTriangle& t : triangles) normal = normal + area_of(Ring(t.vertices.begin(), t.vertices.end()), vertices);
  const FlatView view(normal);
  std::vector<PolygonRings> polygons;
  std::vector<Ring> holes;
  for (Ring& ring : rings_of(outline_of(triangles))) {
    if (dot(area_of(ring, vertices), normal) < 0.0)
      holes.push_back(std::move(ring));
    else
      polygons.push_back({std::move(ring), {}});
  }
  for (Ring& hole : holes) {
    const Point2d place = view.of(vertices[hole.front()]);
    const auto owner =
        std::ranges::find_if(polygons, [&](const PolygonRings& p) { return surrounds(p.shell, place, vertices, view); });
    // Rounding may move a hole that touches its outline out of it
    if (owner != polygons.end())
      owner->holes.push_back(std::move(hole));
    else if (!polygons.empty())
      polygons.front().holes.push_back(std::move(hole));
  }
  return polygons;
}

/// Well-known binary as ISO 19125 has it, with 1000 added to the types of geometries that have a z.
class WellKnownBinary {
 public:
  void begin_geometry(std::uint32_t type) {
    constexpr char little_endian = 1;
    bytes_.push_back(little_endian);
    put(type);
  }
  template <class T>
  void put(T value) {
    static_assert(std::endian::native == std::endian::little);
    const char* const begin = reinterpret_cast<const char*>(&value);
    bytes_.append(begin, sizeof value);
  }
  void put_ring(const Ring& ring, std::span<const Point3d> vertices) {
    put(static_cast<std::uint32_t>(ring.size() + 1));
    for (std::size_t k = 0; k <= ring.size(); ++k) {
      const Point3d& p = vertices[ring[k % ring.size()]];
      for (const double coordinate : {p.x, p.y, p.z}) put(coordinate);
    }
  }
  void append(const std::string& bytes) { bytes_ += bytes; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

constexpr std::uint32_t polygon_z = 1003, multipolygon_z = 1006;

std::string wkb_of(const PolygonRings& polygon, std::span<const Point3d> vertices) {
  WellKnownBinary wkb;
  wkb.begin_geometry(polygon_z);
  wkb.put(static_cast<std::uint32_t>(1 + polygon.holes.size()));
  wkb.put_ring(polygon.shell, vertices);
  for (const Ring& hole : polygon.holes) wkb.put_ring(hole, vertices);
  return wkb.bytes();
}

/// The triangles of a surface, from all of its cells. Vertices that are one, but for the rounding of two cells, become one again.
class WeldedSurface {
 public:
  void add(std::span<const MeshTriangle> triangles, std::span<const Point3d> vertices) {
    for (MeshTriangle t : triangles) {
      for (std::uint32_t& vertex : t.vertices) vertex = welded(vertices[vertex]);
      const auto& [a, b, c] = t.vertices;
      if (a != b && b != c && c != a) triangles_.push_back(t);
    }
  }
  [[nodiscard]] std::string multipolygon_wkb() const {
    const std::vector<PolygonRings> polygons = polygons_of(triangles_, vertices_);
    WellKnownBinary wkb;
    wkb.begin_geometry(multipolygon_z);
    wkb.put(static_cast<std::uint32_t>(polygons.size()));
    for (const PolygonRings& polygon : polygons) wkb.append(wkb_of(polygon, vertices_));
    return wkb.bytes();
  }

 private:
  /// Floats of a cell of 10 km are a millimetre apart, and nobody surveys one.
  static constexpr double tolerance_m = 1e-3, bucket_m = 0.01;
  using Bucket = std::array<std::int64_t, 3>;

  [[nodiscard]] static Bucket bucket_of(const Point3d& p) {
    const auto of = [](double x) { return static_cast<std::int64_t>(std::floor(x / bucket_m)); };
    return {of(p.x), of(p.y), of(p.z)};
  }
  [[nodiscard]] std::optional<std::uint32_t> found_in(const Bucket& bucket, const Point3d& p) const {
    const auto [begin, end] = by_bucket_.equal_range(bucket);
    const auto near = std::find_if(begin, end, [&](const auto& v) { return norm(vertices_[v.second] - p) <= tolerance_m; });
    return near == end ? std::nullopt : std::optional(near->second);
  }
  std::uint32_t welded(const Point3d& p) {
    const Point3d reach{tolerance_m, tolerance_m, tolerance_m};
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

  std::vector<Point3d> vertices_;
  std::vector<MeshTriangle> triangles_;
  std::multimap<Bucket, std::uint32_t> by_bucket_;
};

using SurfaceKey = std::pair<std::uint32_t, std::uint32_t>;  ///< number of the building, number of the surface

struct CollectedSurfaces {
  std::map<SurfaceKey, WeldedSurface> surfaces;
  std::map<std::uint32_t, std::string> ids;
};

void add_part(MeshPart part, CollectedSurfaces& to) {
  if (!part.building) return;
  to.ids[*part.building] = part.id;
  std::ranges::stable_sort(part.triangles, {}, &MeshTriangle::surface);
  for (auto begin = part.triangles.begin(); begin != part.triangles.end();) {
    const auto end = std::find_if(begin, part.triangles.end(), [&](const auto& t) { return t.surface != begin->surface; });
    to.surfaces[{*part.building, begin->surface}].add(std::span(begin, end), part.vertices_projected);
    begin = end;
  }
}

}  // namespace

std::vector<SurfacePolygons> surface_polygons(const Package& package, const std::stop_token& stop) {
  const CellRectangle cells = inventory_of(package).cells;
  CollectedSurfaces collected;
  // Of a few cells at a time, so that the triangles of the city are never in memory as a whole
  constexpr std::int32_t cells_at_a_time = 32;
  for (std::int32_t j = cells.j_begin; j < cells.j_end; ++j)
    for (std::int32_t i = cells.i_begin; i < cells.i_end; i += cells_at_a_time) {
      if (stop.stop_requested()) throw Cancelled("the run was asked to stop");
      const CellRectangle some{i, j, std::min(i + cells_at_a_time, cells.i_end), j + 1};
      for (MeshPart& part : geometry_of(package, some)) add_part(std::move(part), collected);
    }
  std::vector<SurfacePolygons> surfaces;
  surfaces.reserve(collected.surfaces.size());
  for (const auto& [key, surface] : collected.surfaces)
    surfaces.push_back({collected.ids[key.first], key.second, surface.multipolygon_wkb()});
  return surfaces;
}

}  // namespace farlod
