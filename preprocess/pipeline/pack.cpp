// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <span>

#include "city/memory_bound.hpp"
#include "city/plan_boxes.hpp"
#include "contract/cancellation.hpp"
#include "contract/package/description.hpp"
#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "farmap/far_map_baker.hpp"
#include "georeference/problem_locator.hpp"
#include "georeference/terrain_reader.hpp"
#include "ingest/files/input_search.hpp"
#include "package/file_stamp.hpp"
#include "package/package_writer.hpp"
#include "pipeline/area_package.hpp"
#include "pipeline/pack_estimate.hpp"
#include "pipeline/whole_package.hpp"
#include "tiles/tiles.hpp"

namespace farlod::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

/// Some of GDAL's formats are folders: they have a name, but no bytes of their own.
package::InputFile input_file(const std::filesystem::path& path) {
  return {path.filename().string(), std::filesystem::is_regular_file(path) ? stamp_of(path) : package::FileStamp{}};
}

/// The bounding rectangle of the grid in the city frame.
Box2d city_outline(const Grid& grid) {
  const auto [low, high] = grid.rectangle();
  Box2d outline;
  for (const Point2d corner : {low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}})
    outline.add(grid.rotation.city_from_grid(corner));
  return outline;
}

Box2d outline_of(const TerrainRaster& terrain) {
  Box2d outline;
  outline.add(terrain.first);
  outline.add(terrain.node(terrain.columns - 1, terrain.rows - 1));
  return outline;
}

Box2d outline_of(std::span<const Point3d> points) {
  Box2d outline;
  for (const Point3d& p : points) outline.add(horizontal(p));
  return outline;
}

/// The outline of a city without buildings: that of its terrain or relief.
Box2d ground_outline(const LocatedCity& located, const std::optional<TerrainRaster>& terrain) {
  return terrain ? outline_of(*terrain) : outline_of(located.relief_points);
}

/// Drops a relief that is not used: a raster replaces it, or it lies elsewhere than the city. Counts its points as skipped.
void resolve_relief(LocatedCity& located, bool has_terrain, SkippedFeatures& skipped) {
  if (located.relief_points.empty()) return;
  const bool is_elsewhere = !located.city.buildings().empty() &&
                            !boxes_meet(outline_of(located.relief_points), outline_of(std::as_const(located.city).points()));
  if (!has_terrain && !is_elsewhere) return;
  const char* reason = has_terrain ? " (the raster stands in for them)" : " (none lies where the city is)";
  skipped[std::string("points of reliefs") + reason] += located.relief_points.size();
  located.relief_points.clear();
}

/// Refuses an output below a file before the long stages.
void require_folders_above(const std::filesystem::path& output) {
  // What cannot be looked at is refused when it is written
  std::error_code unread;
  for (std::filesystem::path above = std::filesystem::absolute(output, unread).parent_path(); above.has_relative_path();
       above = above.parent_path())
    if (std::filesystem::exists(above, unread) && !std::filesystem::is_directory(above, unread))
      throw OutputError(output.string() + " cannot be written: " + above.string() + ": Not a directory");
}

/// The files that the inputs of the user lead to.
struct ResolvedInputs {
  std::vector<SourceCity> sources;
  std::vector<std::filesystem::path> files;              ///< on disk: an archive is one input, however many of its files are read
  std::optional<georeference::TerrainFile> terrain;      ///< as GDAL opens it
  std::optional<std::filesystem::path> terrain_on_disk;  ///< the file, or the archive that holds it
};

/// The settings of the grid and of the far maps, after the choice where there was one.
struct ResolvedGridSettings {
  align::GridSettings grid;
  FarMapSettings far_map;
};

/// A grid, the ground below it where a raster is read, and how the streets lie.
struct GridOnGround {
  Grid grid;
  std::optional<TerrainRaster> terrain;
  align::Alignment streets = {};
};

/// Runs the stages one after the other, and measures how long each takes.
class Packing {
  // Defined before its first use, since its return type is deduced
  template <class Work>
  auto timed(const std::string& stage, const Work& work) {
    throw_if_cancelled(run_.stop);
    tell(stage, 0, 1);
    const auto start = Clock::now();
    auto value = work();
    result_.stage_seconds.emplace_back(stage, seconds_between(start, Clock::now()));
    return value;
  }

 public:
  Packing(const StageSettings& settings, Report& report, const RunSettings& run, const OnEstimate& on_estimate,
          MemoryBound& bound)
      : settings_(settings),
        report_(report),
        first_problem_(report.problems().size()),
        run_(run),
        on_estimate_(on_estimate),
        bound_(bound) {}

  PackedCity run() {
    // An output folder that must not be replaced ends the run before the long stages. One that may be is removed only after them
    require_folders_above(settings_.output);
    area_ = prepare_output(settings_);
    ResolvedInputs inputs = resolve_inputs();
    LocatedCity located = locate(inputs);
    const ResolvedGridSettings resolved = resolve_grid_settings(located, inputs);
    const auto run_stage = [this](const std::string& stage, const auto& work) { return timed(stage, work); };
    const GridOnGround ground = lay_grid_on_ground(located, inputs, resolved.grid, report_, run_stage);
    result_.street_bearing = ground.streets.bearing;
    result_.alignment_strength = ground.streets.strength;
    describe_place(located, ground.grid, resolved.far_map, inputs);
    if (area_) area_->plan(located.georeference, result_);
    estimate(located, ground, resolved.far_map);
    result_.facets = located.city.facets().size();
    TileSet tiles = timed("tiles", [&] { return cut_city(std::move(located), ground); });
    require_no_problems();
    describe_tiles(tiles);
    if (area_) area_->require_same_city(result_.manifest);
    if (result_.chosen)
      result_.chosen->measured = timed("measure", [&] { return measure(tiles, ground.grid, resolved.far_map); });
    write_package(tiles, ground.grid, resolved.far_map);
    result_.package = package::described(result_.manifest);
    return std::move(result_);
  }

 private:
  ResolvedInputs resolve_inputs() {
    if (!settings_.inputs.empty()) return timed("ingest", [this] { return read_inputs(); });
    return {{}, {}, settings_.terrain, settings_.terrain};
  }

  /// Searches the inputs of the user for files. A raster among them becomes the terrain.
  ResolvedInputs read_inputs() {
    ingest::FoundInputs found = ingest::find_input_files(settings_.inputs, report_);
    ResolvedInputs inputs{{}, {}, settings_.terrain, settings_.terrain};
    if (!found.surface_models.empty()) {
      require_one_raster(found.surface_models);
      const ingest::InputFile& model = found.surface_models.front();
      inputs.terrain = georeference::TerrainFile(model.path, model.is_named);
      inputs.terrain_on_disk = model.on_disk;
    }
    for (const ingest::InputFile& file : found.files) inputs.files.push_back(file.on_disk);
    inputs.files.erase(std::unique(inputs.files.begin(), inputs.files.end()), inputs.files.end());
    inputs.sources = ingest::ingest_all(found.files, settings_.ingest, report_, run_.stop);
    result_.skipped = std::move(found.skipped);
    for (SourceCity& source : inputs.sources) {
      for (const auto& [what, count] : source.skipped) result_.skipped[what] += count;
      std::move(source.notes.begin(), source.notes.end(), std::back_inserter(result_.notes));
    }
    return inputs;
  }

  void require_one_raster(const std::vector<ingest::InputFile>& surface_models) const {
    const std::string& first = surface_models.front().name;
    if (surface_models.size() > 1)
      throw InputError(first + " and " + surface_models[1].name +
                       " are both rasters of heights: give one of them, or their mosaic.");
    if (settings_.terrain)
      throw InputError(first + " is a raster of heights, and so is --terrain " + settings_.terrain->string() +
                       ": give one of them.");
  }

  /// Takes the sources out of `inputs`.
  LocatedCity locate(ResolvedInputs& inputs) {
    georeference::GeoreferenceSettings settings = settings_.georeference;
    if (inputs.sources.empty())
      return {{}, timed("georeference", [&] { return georeference::georeference_of_terrain(*inputs.terrain, settings); })};
    settings.crs_is_for_another |= inputs.terrain && georeference::read_terrain_extent(*inputs.terrain).crs_wkt.empty();
    LocatedCity located =
        timed("georeference", [&] { return georeference::georeference(std::move(inputs.sources), settings, report_); });
    if (located.city.buildings().empty() && located.relief_points.empty())
      throw InputError("No building is left to pack: see --report for what was wrong with each of them.");
    resolve_relief(located, inputs.terrain.has_value(), result_.skipped);
    if (!inputs.terrain && located.relief_points.empty()) require_ground_below_roofs(located.city);
    return located;
  }

  static void require_ground_below_roofs(const CityModel& city) {
    const auto buildings = city.buildings();
    const auto lacks_foot = [](const Building& b) { return b.height_reference == HeightReference::down_to_ground; };
    if (std::none_of(buildings.begin(), buildings.end(), lacks_foot)) return;
    throw InputError(
        "--roof-field tells where roofs are, but not how far down the buildings reach: give --terrain DEM, or --base-field "
        "NAME where the table knows the ground.");
  }

  [[nodiscard]] TerrainRaster read_ground(const georeference::TerrainFile& file, const LocatedCity& located,
                                          const std::optional<Box2d>& wanted_city) const {
    TerrainRaster terrain = georeference::read_terrain(file, settings_.georeference.crs, located.georeference, wanted_city);
    if (std::none_of(terrain.height_m.begin(), terrain.height_m.end(), [](const auto& height) { return height.has_value(); }))
      throw InputError(file.path.string() + " has no heights where the city lies: give a terrain that covers it.");
    return terrain;
  }

  /// Buildings decide where the grid lies, and of a terrain only what it covers is read; a terrain alone decides itself. Each
  /// stage is run by `run_stage(name, work)`.
  template <class RunStage>
  [[nodiscard]] GridOnGround lay_grid_on_ground(const LocatedCity& located, const ResolvedInputs& inputs,
                                                const align::GridSettings& settings, Report& report,
                                                const RunStage& run_stage) const {
    const auto read = [&](const std::optional<Box2d>& wanted_city) -> std::optional<TerrainRaster> {
      if (!inputs.terrain) return std::nullopt;
      return run_stage("terrain", [&] { return read_ground(*inputs.terrain, located, wanted_city); });
    };
    if (located.city.buildings().empty()) {
      std::optional<TerrainRaster> terrain = read(std::nullopt);
      const Grid grid = run_stage("align", [&] { return align::grid_over(ground_outline(located, terrain), settings); });
      return {grid, std::move(terrain)};
    }
    const align::GridAlignment aligned = run_stage("align", [&] { return align::align(located, settings, report); });
    return {aligned.grid, read(city_outline(aligned.grid)), aligned.streets};
  }

  ResolvedGridSettings resolve_grid_settings(const LocatedCity& located, const ResolvedInputs& inputs) {
    ResolvedGridSettings resolved{settings_.grid, settings_.far_map};
    if (!settings_.choice) return resolved;
    const std::optional<GridChoice> best = timed("choice", [&] { return choose(located, inputs, *settings_.choice); });
    result_.chosen = ChosenGrid{best, {}};
    if (!best) return resolved;
    resolved.grid.cell_edge_m = best->cell_edge_m;
    resolved.grid.neighborhood = best->neighborhood;
    resolved.far_map.horizon.tolerance = best->tolerance;
    return resolved;
  }

  /// Tries grids. What is wrong with the city is reported once, when it is packed.
  std::optional<GridChoice> choose(const LocatedCity& located, const ResolvedInputs& inputs, const ChoiceSettings& choice) const {
    Report unread;
    const auto run_untimed = [](const std::string&, const auto& work) { return work(); };
    const auto lay = [&](double cell_edge_m) {
      align::GridSettings settings = settings_.grid;
      settings.cell_edge_m = cell_edge_m;
      GridOnGround ground = lay_grid_on_ground(located, inputs, settings, unread, run_untimed);
      return std::pair(ground.grid, std::move(ground.terrain));
    };
    return choose_grid(located, lay, settings_.assign, settings_.far_map.horizon, choice, run_.stop);
  }

  void estimate(const LocatedCity& located, const GridOnGround& ground, const FarMapSettings& far_map) {
    const auto threads = static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
    const std::size_t ground_points = ground.terrain ? ground.terrain->height_m.size() : located.relief_points.size();
    const auto far_maps = area_ ? std::optional(area_->far_maps()) : std::nullopt;
    const PackMemory memory = memory_of_pack(located.city, ground_points, ground.grid, far_map.kind);
    result_.estimate = estimate_pack(memory, located.city, ground_points, ground.grid, far_map.kind, threads, far_maps);
    // What it took to read the city, it takes again
    const double read_mib = static_cast<double>(bound_.most_needed()) / 1048576.0;
    result_.estimate.least_memory_mib = std::max(result_.estimate.least_memory_mib, read_mib);
    require_memory(result_.estimate, run_);
    blocks_at_once_ = memory.blocks_at_once(area_ ? threads : usual_blocks_at_once, run_);
    bound_.expect(static_cast<std::uint64_t>(memory.in_memory_mib(blocks_at_once_)) << 20);
    if (on_estimate_) on_estimate_(result_.estimate);
  }

  /// The problems found here have positions in the CRS of the package.
  TileSet cut_city(LocatedCity located, const GridOnGround& ground) {
    const std::size_t known = report_.problems().size();
    const Georeference place = located.georeference;
    TileSet tiles = tiles::cut_into_tiles(std::move(located), ground.grid, settings_.assign, ground.terrain, report_, run_.stop);
    if (const auto crs = georeference::Crs::find(place.crs_wkt)) {
      georeference::ProblemLocator locator(*crs, georeference::FileAxes{}, place.origin_m);
      for (Problem& problem : report_.since(known)) locator.locate(problem);
    }
    return tiles;
  }

  /// Called before the long stages, which find no more problems.
  void require_no_problems() const {
    const std::size_t count = report_.since(first_problem_).size();
    if (settings_.problems == ProblemPolicy::pack || count == 0) return;
    throw ProblemsRefused("the city has " + std::to_string(count) + (count == 1 ? " problem" : " problems"));
  }

  [[nodiscard]] FarErrorEstimate measure(const TileSet& tiles, const Grid& grid, const FarMapSettings& far_map) const {
    FarErrorSettings others = settings_.choice->error_sampling;
    others.seed += 1;
    others.cells *= 2;
    return FarMapTrial(tiles, grid, settings_.assign, others, run_.stop).run(grid.neighborhood, far_map.horizon);
  }

  void describe_place(const LocatedCity& located, const Grid& grid, const FarMapSettings& far_map, const ResolvedInputs& inputs) {
    package::Manifest& m = result_.manifest;
    const Georeference& place = located.georeference;
    m.software = std::string("farlod-pack ") + software_version;
    m.crs_wkt = place.crs_wkt;
    m.crs_name = place.crs_name;
    m.epsg = place.epsg;
    m.origin_m = place.origin_m;
    m.convergence = place.convergence;
    m.grid = grid;
    m.assign = settings_.assign == Assign::clip ? "clip" : "whole";
    m.far_map = shape_of(far_map);
    for (const auto& file : inputs.files) m.inputs.push_back(input_file(file));
    if (inputs.terrain_on_disk) m.inputs.push_back(input_file(*inputs.terrain_on_disk));
  }

  void describe_tiles(const TileSet& tiles) {
    package::Manifest& m = result_.manifest;
    m.height_origin_m = tiles.height_origin_m;
    m.buildings = tiles.building_ids.size();
    m.polygons = tiles.polygon_count;
    m.triangles = tiles.triangle_count();
    result_.foundations = tiles.foundation_count;
    if (tiles.foundation_count > 0)
      result_.notes.push_back(
          "Closed down to the ground, since the lowest floor is above it somewhere: " + std::to_string(tiles.foundation_count) +
          " of " + std::to_string(tiles.building_ids.size()) + " buildings.");
    std::map<int, std::uint64_t> counts;
    for (const Problem& p : report_.since(first_problem_)) ++counts[static_cast<int>(p.code)];
    m.problem_counts.assign(counts.begin(), counts.end());
  }

  void write_package(const TileSet& tiles, const Grid& grid, const FarMapSettings& far_map) {
    if (area_) return area_->write(tiles, far_map, result_, run_, blocks_at_once_);
    PackageWriter writer(settings_.output, settings_.overwrite);
    const FarMapBaker baker = timed("city_index", [&] { return FarMapBaker(tiles, grid, settings_.assign, far_map); });
    tiles.let_go();
    write_all_blocks(tiles, baker, writer, blocks_at_once_, run_, result_);
    writer.finish(result_.manifest);
    result_.package_bytes = writer.bytes_written();
    result_.far_map_bytes = writer.far_map_bytes();
  }

  void tell(std::string_view stage, std::size_t done, std::size_t all) const {
    if (run_.on_progress) run_.on_progress({stage, done, all});
  }

  const StageSettings& settings_;
  Report& report_;
  std::size_t first_problem_;  ///< of this pack: those before it are of others
  const RunSettings& run_;
  const OnEstimate& on_estimate_;
  MemoryBound& bound_;
  std::size_t blocks_at_once_ = usual_blocks_at_once;
  std::optional<AreaPackage> area_;
  PackedCity result_;
};

}  // namespace

PackedCity pack(const StageSettings& settings, Report& report, const RunSettings& run, const OnEstimate& on_estimate) {
  std::optional<std::uint64_t> limit_bytes;
  if (run.memory_limit_mib) limit_bytes = *run.memory_limit_mib << 20;
  MemoryBound bound(limit_bytes, run.stop);
  RunSettings bounded = run;
  bounded.stop = bound.stop();
  try {
    return Packing(settings, report, bounded, on_estimate, bound).run();
  } catch (const Cancelled&) {
    if (!bound.is_exceeded()) throw;
  }
  throw LimitReached("Packing needs more than " + std::to_string(bound.exceeded_at() >> 20) +
                     " MiB, besides what lies on disk; " + std::to_string(*run.memory_limit_mib) +
                     " MiB are allowed: raise the memory limit, or pack fewer inputs at "
                     "a time.");
}

}  // namespace farlod::pipeline
