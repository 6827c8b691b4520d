// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/preprocess/module/packing.hpp"

#include <pybind11/stl.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/pack.hpp"
#include "python/binding/interruptible_run.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace farlod {
namespace {

template <class T>
T either(const char* name, const std::string& word, const std::pair<const char*, T>& a, const std::pair<const char*, T>& b) {
  if (word == a.first) return a.second;
  if (word == b.first) return b.second;
  throw InvalidArgument(std::string(name) + " is \"" + word + "\": give \"" + a.first + "\" or \"" + b.first + "\"");
}

void set_inputs(PackSettings& settings, const std::vector<std::string>& inputs) {
  settings.inputs.assign(inputs.begin(), inputs.end());
}

void set_terrain(PackSettings& settings, const std::vector<std::string>& tiles) {
  settings.terrain.assign(tiles.begin(), tiles.end());
}
void set_far_terrains(PackSettings& settings, const std::vector<std::string>& far_terrains) {
  settings.far_terrains.assign(far_terrains.begin(), far_terrains.end());
}

void set_obj_origin(PackSettings& settings, const std::array<double, 3>& origin_m) {
  settings.obj_origin = Point3d{origin_m[0], origin_m[1], origin_m[2]};
}

void set_bearing(PackSettings& settings, double bearing_deg) {
  settings.align = AlignMode::fixed;
  settings.fixed_bearing = Angle::degrees(bearing_deg);
}

void set_alignment(PackSettings& settings, const std::string& word) {
  settings.align = either<AlignMode>("align", word, {"auto", AlignMode::automatic}, {"none", AlignMode::none});
}

void set_area(PackSettings& settings, const std::array<double, 4>& bbox_m) {
  settings.area = Box2d{{bbox_m[0], bbox_m[1]}, {bbox_m[2], bbox_m[3]}};
}

void set_area_file(PackSettings& settings, const std::string& file) { settings.area = std::filesystem::path(file); }

py::list rows_of(const Report& report) {
  py::list rows;
  for (const Problem& problem : report.problems()) {
    const ProblemDescription& kind = describe(problem.code);
    py::object position = py::none();
    if (problem.position) position = py::make_tuple(problem.position->x, problem.position->y, problem.position->z);
    rows.append(py::dict("code"_a = static_cast<int>(problem.code), "problem"_a = std::string(kind.slug),
                         "effect"_a = std::string(name_of(kind.effect)), "file"_a = problem.source, "place"_a = problem.place,
                         "detail"_a = problem.detail, "position"_a = position, "ring"_a = problem.ring));
  }
  return rows;
}

py::dict dict_of(const PackResult& result) {
  py::dict seconds;
  for (const auto& [stage, s] : result.stage_seconds) seconds[py::str(stage)] = s;
  py::dict facts("street_bearing_deg"_a = result.street_bearing.degrees(), "alignment_strength"_a = result.alignment_strength,
                 "facets"_a = result.facets, "foundations"_a = result.foundations, "crowns_of_trees"_a = result.crowns.of_trees,
                 "crowns_of_canopy"_a = result.crowns.of_canopy, "skipped"_a = result.skipped, "notes"_a = result.notes,
                 "package_bytes"_a = result.package_bytes, "far_map_bytes"_a = result.far_map_bytes, "seconds"_a = seconds);
  if (const auto& p = result.looks.lon_lat_deg) {
    facts["latitude"] = p->y;
    facts["longitude"] = p->x;
  }
  if (const auto& h = result.looks.heights)
    facts["heights_m"] = py::dict("least"_a = h->least_m, "median"_a = h->median_m, "tallest"_a = h->tallest_m);
  if (const auto& g = result.looks.ground) facts["ground_m"] = py::make_tuple(g->low_m, g->high_m);
  if (result.chosen)
    facts["error_on_trial"] = py::dict("mean"_a = result.chosen->measured.mean_error, "max"_a = result.chosen->measured.max_error,
                                       "receivers"_a = result.chosen->measured.receivers);
  return facts;
}

/// What came of packing, and what is wrong with the city. Problems are told with whatever ends the run, too: `report` is a list
/// that they are added to.
py::dict pack_in_python(const PackSettings& settings, py::list problems, const CallerSettings& caller) {
  Report report;
  const auto tell = [&] {
    for (const py::handle row : rows_of(report)) problems.append(row);
  };
  PackResult result;
  try {
    run_interruptibly(caller, [&](const RunSettings& run) { result = pack(settings, report, run); });
  } catch (...) {
    tell();
    throw;
  }
  tell();
  return dict_of(result);
}

void add_footprints(py::module_& module) {
  py::class_<FootprintSettings>(module, "FootprintSettings")
      .def(py::init<>())
      .def_readwrite("height_field", &FootprintSettings::height_field)
      .def_readwrite("base_field", &FootprintSettings::base_field)
      .def_readwrite("storeys_field", &FootprintSettings::storeys_field)
      .def_readwrite("roof_field", &FootprintSettings::roof_field)
      .def_readwrite("floor_height_m", &FootprintSettings::floor_height_m)
      .def_readwrite("default_height_m", &FootprintSettings::default_height_m)
      .def_readwrite("unknown_heights", &FootprintSettings::unknown_heights)
      .def_readwrite("layer", &FootprintSettings::layer)
      .def_readwrite("encoding", &FootprintSettings::encoding);
}

void add_trees(py::module_& module) {
  py::class_<TreeSettings>(module, "TreeSettings")
      .def(py::init<>())
      .def("set_files",
           [](TreeSettings& trees, const std::vector<std::string>& files) { trees.files.assign(files.begin(), files.end()); })
      .def("set_canopy", [](TreeSettings& trees, const std::string& file) { trees.canopy = file; })
      .def("set_trunks", [](TreeSettings& trees, const std::string& file) { trees.trunks = file; })
      .def("set_elevations", [](TreeSettings& trees) { trees.heights = CanopyHeights::elevations; })
      .def_readwrite("height_field", &TreeSettings::height_field)
      .def_readwrite("crown_field", &TreeSettings::crown_field)
      .def_readwrite("trunk_field", &TreeSettings::trunk_field)
      .def_readwrite("layer", &TreeSettings::layer)
      .def_readwrite("encoding", &TreeSettings::encoding)
      .def_readwrite("trunk_ratio", &TreeSettings::trunk_ratio);
}

void set_words(PackSettings& settings, const std::string& up, const std::string& assign, const std::string& far_map,
               const std::string& surface, const std::string& problems) {
  if (up != "auto") settings.up = either<UpAxis>("up", up, {"z", UpAxis::z}, {"y", UpAxis::y});
  settings.assign = either<Assign>("assign", assign, {"clip", Assign::clip}, {"whole", Assign::whole});
  settings.far_map = either<FarMapKind>("far_map", far_map, {"horizon", FarMapKind::horizon}, {"box", FarMapKind::box});
  settings.surface =
      either<SurfaceReading>("surface", surface, {"auto", SurfaceReading::automatic}, {"tin", SurfaceReading::tin});
  settings.problems =
      either<ProblemPolicy>("problems", problems, {"pack", ProblemPolicy::pack}, {"refuse", ProblemPolicy::refuse});
}

PackSettings settings_for(const std::string& output) {
  PackSettings settings;
  settings.output = output;
  return settings;
}

void add_pack_settings(py::module_& module) {
  py::class_<PackSettings>(module, "PackSettings")
      .def(py::init(&settings_for), py::arg("output"))
      .def("set_inputs", &set_inputs)
      .def("set_terrain", &set_terrain)
      .def("set_far_terrains", &set_far_terrains)
      .def("set_obj_origin", &set_obj_origin)
      .def("set_bearing", &set_bearing)
      .def("set_alignment", &set_alignment)
      .def("set_area", &set_area)
      .def("set_area_file", &set_area_file)
      .def("set_words", &set_words, py::arg("up"), py::arg("assign"), py::arg("far_map"), py::arg("surface"), py::arg("problems"))
      .def("set_overwrite", [](PackSettings& settings) { settings.overwrite = Overwrite::replace; })
      .def_readwrite("terrain_offset_m", &PackSettings::terrain_offset_m)
      .def_readwrite("crs", &PackSettings::crs)
      .def_readwrite("out_crs", &PackSettings::out_crs)
      .def_readwrite("lod", &PackSettings::lod)
      .def_readwrite("ground_names", &PackSettings::ground_names)
      .def_readwrite("footprints", &PackSettings::footprints)
      .def_readwrite("trees", &PackSettings::trees)
      .def_readwrite("cell_edge_m", &PackSettings::cell_edge_m)
      .def_readwrite("neighborhood", &PackSettings::neighborhood)
      .def_readwrite("max_error", &PackSettings::max_error);
}

}  // namespace

void add_packing(py::module_& module) {
  py::class_<CallerSettings>(module, "CallerSettings", py::module_local())
      .def(py::init([](std::size_t threads, std::optional<std::uint64_t> memory_limit_mib, const py::object& progress) {
             return CallerSettings{threads, memory_limit_mib, progress};
           }),
           py::arg("threads"), py::arg("memory_limit_mib"), py::arg("progress"));
  add_footprints(module);
  add_trees(module);
  add_pack_settings(module);
  module.def("pack", &pack_in_python, py::arg("settings"), py::arg("problems"), py::arg("caller"));
}

}  // namespace farlod
