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
  void put_ring(const std::vector<Point3d>& ring) {
    put(static_cast<std::uint32_t>(ring.size() + 1));
    for (std::size_t k = 0; k <= ring.size(); ++k) {
      const Point3d& p = ring[k % ring.size()];
      for (const double coordinate : {p.x, p.y, p.z}) put(coordinate);
    }
  }
  void append(const std::string& bytes) { bytes_ += bytes; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

constexpr std::uint32_t polygon_z = 1003, multipolygon_z = 1006;

std::string wkb_of(const SurfacePolygon& polygon) {
  WellKnownBinary wkb;
  wkb.begin_geometry(polygon_z);
  wkb.put(static_cast<std::uint32_t>(1 + polygon.holes.size()));
  wkb.put_ring(polygon.shell);
  for (const std::vector<Point3d>& hole : polygon.holes) wkb.put_ring(hole);
  return wkb.bytes();
}

std::string multipolygon_wkb_of(std::span<const std::array<Point3d, 3>> triangles) {
  const std::vector<SurfacePolygon> polygons = polygons_of(triangles);
  WellKnownBinary wkb;
  wkb.begin_geometry(multipolygon_z);
  wkb.put(static_cast<std::uint32_t>(polygons.size()));
  for (const SurfacePolygon& polygon : polygons) wkb.append(wkb_of(polygon));
  return wkb.bytes();
}

using SurfaceKey = std::pair<std::uint32_t, std::uint32_t>;  ///< number of the building, number of the surface

struct CollectedSurfaces {
  std::map<SurfaceKey, std::vector<std::array<Point3d, 3>>> triangles;
  std::map<std::uint32_t, std::string> ids;
};

void add_part(const MeshPart& part, CollectedSurfaces& to) {
  if (!part.building) return;
  to.ids[*part.building] = part.id;
  const std::vector<Point3d>& p = part.vertices_projected;
  for (const MeshTriangle& t : part.triangles)
    to.triangles[{*part.building, t.surface}].push_back({p[t.vertices[0]], p[t.vertices[1]], p[t.vertices[2]]});
}

/// All surfaces of all buildings, by building and surface. The floors of the city are among them, the ground is not. Throws
/// Cancelled, PackageUnusable, PackageDamaged.
std::vector<SurfacePolygons> surface_polygons(const Package& package, const std::stop_token& stop) {
  const CellRectangle cells = inventory_of(package).cells;
  CollectedSurfaces collected;
  // Of a few cells at a time: geometry_of() takes no more than 10,000
  constexpr std::int32_t cells_at_a_time = 32;
  for (std::int32_t j = cells.j_begin; j < cells.j_end; ++j)
    for (std::int32_t i = cells.i_begin; i < cells.i_end; i += cells_at_a_time) {
      if (stop.stop_requested()) throw Cancelled("the run was asked to stop");
      const CellRectangle some{i, j, std::min(i + cells_at_a_time, cells.i_end), j + 1};
      for (const MeshPart& part : geometry_of(package, some)) add_part(part, collected);
    }
  std::vector<SurfacePolygons> surfaces;
  surfaces.reserve(collected.triangles.size());
  for (const auto& [key, triangles] : collected.triangles)
    surfaces.push_back({collected.ids[key.first], key.second, multipolygon_wkb_of(triangles)});
  return surfaces;
}

using BboxInPython = std::array<double, 4>;  ///< west, south, east, north

py::dict description_of(const Package& package) {
  const PackageDescription& d = package.description();
  const PackageInventory inventory = inventory_of(package);
  py::list inputs;
  for (const PackedInput& input : inventory.inputs) inputs.append(input.name);
  const auto box_in_python = [](const Box2d& b) { return BboxInPython{b.low.x, b.low.y, b.high.x, b.high.y}; };
  return py::dict("software"_a = d.software, "crs_wkt"_a = d.crs_wkt, "crs_name"_a = d.crs_name, "epsg"_a = d.epsg,
                  "bounds_m"_a = box_in_python(d.outline_projected), "city_m"_a = box_in_python(d.city_projected),
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
