// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "base/run_settings.hpp"
#include "farlod/error.hpp"
#include "farlod/pack.hpp"
#include "pipeline/pack.hpp"

namespace farlod::pipeline {
namespace {

void check_files(const PackSettings& s) {
  if (s.output.empty()) throw InvalidArgument("output is empty: give the folder of the package, NAME.farlod");
  if (s.inputs.empty() && s.terrain.empty() && !s.merge)
    throw InvalidArgument("inputs are empty: give a city file, or a terrain");
  for (const std::filesystem::path& input : s.inputs)
    if (input.empty()) throw InvalidArgument("one of the inputs has an empty name: give the path of a file or a folder");
  if (std::any_of(s.terrain.begin(), s.terrain.end(), [](const auto& path) { return path.empty(); }))
    throw InvalidArgument("terrain is empty: give the path of a raster, or no terrain");
  for (const auto& file : s.far_terrains)
    if (file.empty()) throw InvalidArgument("far_terrains has an empty path: give the paths of rasters");
  require_between("terrain_offset_m", s.terrain_offset_m, -1000.0, 1000.0);
  require_one_of("surface", s.surface, SurfaceReading::tin);
  require_one_of("overwrite", s.overwrite, Overwrite::replace);
  require_one_of("problems", s.problems, ProblemPolicy::refuse);
}

void check_input(const PackSettings& s) {
  if (s.up) require_one_of("up", *s.up, UpAxis::y);
  for (const std::string& name : s.ground_names)
    if (name.empty()) throw InvalidArgument("one of ground_names is empty: give words such as \"Gelaende\"");
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
  stages.terrain_offset_m = s.terrain_offset_m;
  stages.surface = s.surface;
  stages.far_terrains = s.far_terrains;
  stages.trees = s.trees;
  stages.output = s.output;
  stages.overwrite = s.overwrite;
  stages.ingest = {s.footprints, {s.lod}, s.obj_origin, s.up, s.ground_names};
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

namespace farlod::pipeline {
namespace {

/// What a map of 2 m costs for each of its receivers: its horizon, the edges that are looked at for it, near and far, and a share
/// of the gathering of the cell's edges and of its far map. Constants from docs/decisions/0017; only their ratios matter.
double expected_receiver_us(const FarErrorEstimate& far_error, double cell_edge_m) {
  constexpr double horizon_us = 1.1, edge_us = 0.00025, bake_us = 2200.0, gather_us = 0.1, grid_step_m = 2.0;
  const double edges = far_error.explicit_edges_per_cell + far_error.near_triangles_per_cell;
  const double receivers = std::max(1.0, cell_edge_m * cell_edge_m / (grid_step_m * grid_step_m));
  return horizon_us + edge_us * edges + (bake_us + gather_us * edges) / receivers;
}

bool keeps(const FarErrorEstimate& far_error, double max_far_error) {
  return far_error.receivers > 0 && far_error.max_error <= max_far_error && far_error.p99_half_width <= max_far_error;
}

class GridChooser {
 public:
  GridChooser(const LocatedCity& city, Assign assign, const HorizonMapSettings& far_map, const ChoiceSettings& settings,
              std::stop_token stop)
      : city_(city), assign_(assign), far_map_(far_map), settings_(settings), stop_(std::move(stop)) {}

  void try_cells(double cell_edge_m, const LayGrid& lay) {
    auto [grid, terrain] = lay(cell_edge_m);
    Report unread;  // the run itself reports what it finds
    const TileSet tiles = tiles::cut_into_tiles(city_, grid, assign_, terrain, unread, stop_);
    const FarMapTrial trial(tiles, grid, assign_, settings_.error_sampling, stop_);
    for (const int neighborhood : settings_.neighborhoods) try_tolerances(trial, grid.cell_edge_m, neighborhood);
  }
  std::optional<GridChoice> best;

 private:
  /// The coarsest that is fine enough.
  void try_tolerances(const FarMapTrial& trial, double cell_edge_m, int neighborhood) {
    for (const double tolerance : settings_.tolerances) {
      HorizonMapSettings far_map = far_map_;
      far_map.tolerance = tolerance;
      GridChoice choice{cell_edge_m, neighborhood, tolerance, trial.run(neighborhood, far_map), 0.0};
      choice.receiver_us = expected_receiver_us(choice.far_error, cell_edge_m);
      if (!keeps(choice.far_error, settings_.max_far_error)) continue;
      if (!best || choice.receiver_us < best->receiver_us) best = choice;
      return;
    }
  }

  const LocatedCity& city_;
  Assign assign_;
  HorizonMapSettings far_map_;
  const ChoiceSettings& settings_;
  std::stop_token stop_;
};

}  // namespace

std::optional<GridChoice> choose_grid(const LocatedCity& city, const LayGrid& lay, Assign assign,
                                      const HorizonMapSettings& far_map, const ChoiceSettings& settings,
                                      const std::stop_token& stop) {
  GridChooser chooser(city, assign, far_map, settings, stop);
  for (const double cell_edge_m : settings.cell_edges_m) chooser.try_cells(cell_edge_m, lay);
  return chooser.best;
}

}  // namespace farlod::pipeline
