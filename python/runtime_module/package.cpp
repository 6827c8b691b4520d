// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/runtime_module/package.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/plan_view.hpp"
#include "farlod/point.hpp"
#include "python/binding/interruptible_run.hpp"
#include "python/binding/owned_array.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace farlod {
namespace {

/// A surface of a building: a polygon for each of its pieces that are not connected.
struct SurfacePolygons {
  std::string building;
  std::uint32_t surface = 0;     ///< its number within the building, as SurfaceMean has it
  std::string multipolygon_wkb;  ///< MultiPolygon Z in the package's CRS, ISO well-known binary, little endian
};

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

/// All surfaces of all buildings, by building and surface. The floors of the city are among them, the ground is not. Throws
/// Cancelled, PackageUnusable, PackageDamaged.
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

using BboxInPython = std::array<double, 4>;  ///< west, south, east, north

py::dict description_of(const Package& package) {
  const PackageDescription& d = package.description();
  const PackageInventory inventory = inventory_of(package);
  py::list inputs;
  for (const PackedInput& input : inventory.inputs) inputs.append(input.name);
  return py::dict("software"_a = d.software, "crs_wkt"_a = d.crs_wkt, "crs_name"_a = d.crs_name, "epsg"_a = d.epsg,
                  "bounds_m"_a = BboxInPython{d.outline_projected.low.x, d.outline_projected.low.y, d.outline_projected.high.x,
                                              d.outline_projected.high.y},
                  "grid_bearing_deg"_a = d.grid_bearing.degrees(), "convergence_deg"_a = d.convergence.degrees(),
                  "cell_edge_m"_a = d.cell_edge_m, "neighborhood"_a = d.neighborhood, "columns"_a = d.columns, "rows"_a = d.rows,
                  "far_map_kind"_a = d.far_map_kind, "cells_with_far_map"_a = d.cells_with_far_map, "buildings"_a = d.buildings,
                  "polygons"_a = d.polygons, "triangles"_a = d.triangles, "inputs"_a = inputs, "problems"_a = inventory.problems);
}

py::dict check_in_python(const Package& package, const CallerSettings& caller) {
  PackageCheck check;
  run_interruptibly(caller, [&](const RunSettings& run) { check = check_package(package, run); });
  py::list damage;
  for (const PackageDamage& found : check.damage) damage.append(found.what);
  return py::dict("files"_a = check.files, "bytes"_a = check.bytes, "cells"_a = check.cells, "far_maps"_a = check.far_maps,
                  "damage"_a = damage);
}

py::array_t<float> ground_in_python(const Package& package, const RasterPlan& plan, const CallerSettings& caller) {
  std::vector<float> heights_m;
  run_interruptibly(caller, [&](const RunSettings& run) { heights_m = ground_heights(package, plan, run); });
  return owned_array(std::move(heights_m), {static_cast<py::ssize_t>(plan.rows), static_cast<py::ssize_t>(plan.columns)});
}

/// Segments as an array (n, 2, 2): two ends, x and y.
py::array_t<double> outlines_in_python(const Package& package, const BboxInPython& bbox_m, const CallerSettings& caller) {
  constexpr std::size_t most_segments = 50'000'000;
  const Box2d part{{bbox_m[0], bbox_m[1]}, {bbox_m[2], bbox_m[3]}};
  std::optional<BuildingOutlines> outlines;
  run_interruptibly(caller, [&](const RunSettings& run) { outlines = building_outlines(package, part, most_segments, run); });
  if (!outlines) throw LimitReached("the buildings here have more than 50,000,000 edges: choose a smaller part");
  std::vector<double> ends;
  ends.reserve(4 * outlines->segments.size());
  for (const PlanSegment& s : outlines->segments) ends.insert(ends.end(), {s.a.x, s.a.y, s.b.x, s.b.y});
  return owned_array(std::move(ends), {static_cast<py::ssize_t>(outlines->segments.size()), 2, 2});
}

/// Of each building that has surfaces: its id, the numbers of the surfaces, and their polygons as well-known binary.
py::list polygons_in_python(const Package& package, const CallerSettings& caller) {
  std::vector<SurfacePolygons> surfaces;
  run_interruptibly(caller, [&](const RunSettings& run) { surfaces = surface_polygons(package, run.stop); });
  py::list rows;
  for (const SurfacePolygons& s : surfaces) rows.append(py::make_tuple(s.building, s.surface, py::bytes(s.multipolygon_wkb)));
  return rows;
}

}  // namespace

void add_package(py::module_& module) {
  py::class_<Package>(module, "Package")
      .def(py::init([](const std::string& folder) { return Package(std::filesystem::path(folder)); }), py::arg("folder"),
           py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("is_open", &Package::is_open)
      .def("close", &Package::close)
      .def("description", &description_of);
  module.def("check_package", &check_in_python, py::arg("package"), py::arg("caller"));
  module.def("ground_heights", &ground_in_python, py::arg("package"), py::arg("plan"), py::arg("caller"));
  module.def("building_outlines", &outlines_in_python, py::arg("package"), py::arg("bbox_m"), py::arg("caller"));
  module.def("surface_polygons", &polygons_in_python, py::arg("package"), py::arg("caller"));
}

}  // namespace farlod
