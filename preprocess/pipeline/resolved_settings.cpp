// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>
#include <oneapi/tbb/task_arena.h>

#include "base/run_settings.hpp"
#include "farlod/error.hpp"
#include "farlod/pack.hpp"
#include "pipeline/pack.hpp"

namespace farlod::pipeline {
namespace {

void check_files(const PackSettings& s) {
  if (s.output.empty()) throw InvalidArgument("output is empty: give the folder of the package, NAME.farlod");
  if (s.inputs.empty() && !s.terrain && !s.merge) throw InvalidArgument("inputs are empty: give a city file, or a terrain");
  for (const std::filesystem::path& input : s.inputs)
    if (input.empty()) throw InvalidArgument("one of the inputs has an empty name: give the path of a file or a folder");
  if (s.terrain && s.terrain->empty()) throw InvalidArgument("terrain is empty: give the path of a raster, or no terrain");
  require_one_of("overwrite", s.overwrite, Overwrite::replace);
  require_one_of("problems", s.problems, ProblemPolicy::refuse);
}

void check_input(const PackSettings& s) {
  require_one_of("up", s.up, UpAxis::y);
  if (s.lod) require_between("lod", *s.lod, 0, 3);
  constexpr double farthest_m = 1e9;
  if (s.obj_origin) {
    require_between("obj_origin.x", s.obj_origin->x, -farthest_m, farthest_m);
    require_between("obj_origin.y", s.obj_origin->y, -farthest_m, farthest_m);
    require_between("obj_origin.z", s.obj_origin->z, -farthest_m, farthest_m);
  }
  require_between("floor_height_m", s.footprints.floor_height_m, 1.0, 20.0);
  if (s.footprints.default_height_m) require_between("default_height_m", *s.footprints.default_height_m, 0.01, 1000.0);
}

void check_trees(const TreeSettings& trees) {
  for (const std::filesystem::path& file : trees.files)
    if (file.empty()) throw InvalidArgument("one of trees.files has an empty name: give the path of a file");
  if (trees.canopy && trees.canopy->empty()) throw InvalidArgument("trees.canopy is empty: give the path of a raster, or none");
  if (trees.trunks && trees.trunks->empty()) throw InvalidArgument("trees.trunks is empty: give the path of a raster, or none");
  if (trees.trunks && !trees.canopy)
    throw InvalidArgument("trees.trunks is a raster of the trunks below a canopy: give trees.canopy, too");
  require_one_of("trees.heights", trees.heights, CanopyHeights::elevations);
  require_between("trees.trunk_ratio", trees.trunk_ratio, 0.0, 0.95);
}

void check_grid(const PackSettings& s) {
  require_one_of("align", s.align, AlignMode::fixed);
  require_one_of("assign", s.assign, Assign::whole);
  require_one_of("far_map", s.far_map, FarMapKind::box);
  require_between("fixed_bearing in degrees", s.fixed_bearing.degrees(), -360.0, 360.0);
  if (s.cell_edge_m) require_between("cell_edge_m", *s.cell_edge_m, 0.5, 10'000.0);
  if (s.neighborhood) require_between("neighborhood", *s.neighborhood, 1, 999);
  if (s.neighborhood && *s.neighborhood % 2 == 0)
    throw InvalidArgument(fmt::format(
        "neighborhood is {}, which is even: a neighborhood has a cell in its middle, give an odd number", *s.neighborhood));
  if (!s.max_error) return;
  require_between("max_error", *s.max_error, 0.0001, 1.0);
  if (s.far_map == FarMapKind::box)
    throw InvalidArgument("far maps of the kind box keep no error: leave max_error out, or choose the kind horizon");
}

void check_area(const PackSettings& s) {
  if (!s.area) return;
  if (const auto* file = std::get_if<std::filesystem::path>(&*s.area)) {
    if (file->empty()) throw InvalidArgument("area is empty: give the path of a file, a rectangle, or no area");
    return;
  }
  const Box2d& box = std::get<Box2d>(*s.area);
  constexpr double farthest_m = 1e8;  // no map is as large
  for (const double x : {box.low.x, box.low.y, box.high.x, box.high.y})
    require_between("a coordinate of area", x, -farthest_m, farthest_m);
  if (box.low.x >= box.high.x || box.low.y >= box.high.y)
    throw InvalidArgument("area is empty: give a rectangle whose low is less than its high, in both coordinates");
}

void check_parts(const PackSettings& s) {
  if (s.shard && s.merge) throw InvalidArgument("shard and merge exclude each other: merge when all shards are done");
  if (s.shard && s.shard->index >= s.shard->count)
    throw InvalidArgument(fmt::format("there is no shard {} of {}: they count from 0", s.shard->index, s.shard->count));
}

/// Half of the error is left for the sky between the samples of an evaluation. What the caller fixes is not chosen.
ChoiceSettings choice_of(const PackSettings& s) {
  ChoiceSettings choice;
  choice.max_far_error = 0.5 * *s.max_error;
  if (s.cell_edge_m) choice.cell_edges_m = {*s.cell_edge_m};
  if (s.neighborhood) choice.neighborhoods = {*s.neighborhood};
  return choice;
}

void choose_part(const PackSettings& s, StageSettings& stages) {
  if (s.merge) stages.part = PackPart::merge;
  if (!s.shard) return;
  stages.part = PackPart::shard;
  stages.shard = *s.shard;
}

void check(const PackSettings& s) {
  check_files(s);
  check_input(s);
  check_trees(s.trees);
  check_grid(s);
  check_area(s);
  check_parts(s);
}

}  // namespace

StageSettings resolved(const PackSettings& s) {
  check(s);
  StageSettings stages;
  stages.inputs = s.inputs;
  stages.terrain = s.terrain;
  stages.trees = s.trees;
  stages.output = s.output;
  stages.overwrite = s.overwrite;
  stages.ingest = {s.footprints, {s.lod}, s.obj_origin, s.up};
  stages.georeference.crs = s.crs;
  stages.georeference.out_crs = s.out_crs;
  if (s.cell_edge_m) stages.grid.cell_edge_m = *s.cell_edge_m;
  if (s.neighborhood) stages.grid.neighborhood = *s.neighborhood;
  stages.grid.align = s.align;
  stages.grid.fixed_bearing = s.fixed_bearing;
  stages.assign = s.assign;
  stages.far_map.kind = s.far_map;
  stages.problems = s.problems;
  stages.area = s.area;
  if (s.max_error) stages.choice = choice_of(s);
  stages.resume = s.resume;
  choose_part(s, stages);
  return stages;
}

}  // namespace farlod::pipeline

namespace farlod {

PackResult pack(const PackSettings& settings, Report& report, const RunSettings& run, const OnEstimate& on_estimate) {
  const pipeline::StageSettings stages = pipeline::resolved(settings);
  require_usable(run);
  oneapi::tbb::task_arena arena(static_cast<int>(thread_count(run)));
  // What a caller of the library sees is the base. NOLINTNEXTLINE(cppcoreguidelines-slicing)
  return arena.execute([&]() -> PackResult { return pipeline::pack(stages, report, run, on_estimate); });
}

}  // namespace farlod
