// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <span>

#include "city/input_error.hpp"
#include "farlod/version.hpp"
#include "georeference/problem_locator.hpp"
#include "georeference/terrain_reader.hpp"
#include "ingest/files/input_search.hpp"
#include "package/file_stamp.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

/// Some of GDAL's formats are folders: they have a name, but no bytes of their own.
package::InputFile input_file(const std::filesystem::path& path) {
  return {path.filename().string(), std::filesystem::is_regular_file(path) ? stamp_of(path) : package::FileStamp{}};
}

/// The grid's rectangle in the frame that it is turned against.
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

/// Of a city that is ground alone.
Box2d ground_outline(const LocatedCity& located, const std::optional<TerrainRaster>& terrain) {
  return terrain ? outline_of(*terrain) : outline_of(located.relief_points);
}

bool overlap(const Box2d& a, const Box2d& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// What becomes of it depends on what else there is: a raster that was asked for stands in for reliefs, and a relief of another
/// place says nothing about this one.
void resolve_relief(LocatedCity& located, bool has_terrain, SkippedFeatures& skipped) {
  if (located.relief_points.empty()) return;
  const bool is_elsewhere = !located.city.buildings().empty() &&
                            !overlap(outline_of(located.relief_points), outline_of(std::as_const(located.city).points()));
  if (!has_terrain && !is_elsewhere) return;
  const char* reason = has_terrain ? " (the raster stands in for them)" : " (none lies where the city is)";
  skipped[std::string("points of reliefs") + reason] += located.relief_points.size();
  located.relief_points.clear();
}

/// What can never be a folder is said before the long work, too.
void require_folders_above(const std::filesystem::path& output) {
  for (std::filesystem::path above = std::filesystem::absolute(output).parent_path(); above.has_relative_path();
       above = above.parent_path())
    if (std::filesystem::exists(above) && !std::filesystem::is_directory(above))
      throw PackageWriteError(output.string() + " cannot be written: " + above.string() + ": Not a directory");
}

/// Runs the stages one after the other, and remembers how long each took.
class Packing {
 public:
  Packing(const PackSettings& settings, Report& report, const PackProgress& progress, const TellEstimate& tell)
      : settings_(settings), report_(report), progress_(progress), tell_(tell) {}

  template <class Work>
  auto timed(const std::string& stage, const Work& work) {
    progress_(stage, 0, 1);
    const auto start = Clock::now();
    auto value = work();
    result_.stage_seconds.emplace_back(stage, seconds_between(start, Clock::now()));
    return value;
  }

  PackResult run() {
    // A folder that may not be written ends the run before the long work; one that may be is swept only after it
    require_folders_above(settings_.output);
    require_room(settings_.output, settings_.overwrite);
    LocatedCity located = read_and_locate();
    if (settings_.choice) result_.chosen = timed("choice", [&] { return choose(located); });
    const auto [grid, terrain] = lay_grid_on_ground(located);
    estimate(located, grid, terrain);
    describe_place(located, grid);
    result_.facets = located.city.facets().size();
    TileSet tiles = timed("tiles", [&, &grid = grid, &terrain = terrain] { return cut_city(std::move(located), grid, terrain); });
    require_no_problems();
    describe_tiles(tiles);
    if (result_.chosen) result_.chosen->measured = timed("measure", [&] { return measure(tiles, grid); });
    write_package(tiles, grid);
    return std::move(result_);
  }

 private:
  /// The names that the user gave become the files behind them; a raster among them becomes the terrain.
  std::vector<SourceCity> read_inputs() {
    FoundInputs found = find_input_files(settings_.inputs, report_);
    take_surface_model(found.surface_models);
    settings_.inputs.clear();
    for (const InputFile& file : found.files) settings_.inputs.push_back(file.on_disk);
    // An archive is one input, however many of its files are read
    settings_.inputs.erase(std::unique(settings_.inputs.begin(), settings_.inputs.end()), settings_.inputs.end());
    std::vector<SourceCity> sources = ingest_all(found.files, settings_.ingest, report_);
    result_.skipped = std::move(found.skipped);
    for (SourceCity& source : sources) {
      for (const auto& [what, count] : source.skipped) result_.skipped[what] += count;
      std::move(source.notes.begin(), source.notes.end(), std::back_inserter(result_.notes));
    }
    return sources;
  }

  void take_surface_model(const std::vector<InputFile>& surface_models) {
    if (surface_models.empty()) return;
    const std::string first = surface_models.front().name;
    if (surface_models.size() > 1)
      throw InputError(first + " and " + surface_models[1].name +
                       " are both rasters of heights: give one of them, or their mosaic.");
    if (settings_.terrain)
      throw InputError(first + " is a raster of heights, and so is --terrain " + settings_.terrain->string() +
                       ": give one of them.");
    settings_.terrain = surface_models.front().path;
    terrain_on_disk_ = surface_models.front().on_disk;
  }

  LocatedCity read_and_locate() {
    std::vector<SourceCity> sources;
    if (!settings_.inputs.empty()) sources = timed("ingest", [&] { return read_inputs(); });
    if (sources.empty())
      return {{}, timed("georeference", [&] { return georeference_of_terrain(*settings_.terrain, settings_.georeference); })};
    settings_.georeference.crs_is_for_another |= settings_.terrain && read_terrain_extent(*settings_.terrain).crs_wkt.empty();
    LocatedCity located =
        timed("georeference", [&] { return georeference(std::move(sources), settings_.georeference, report_); });
    if (located.city.buildings().empty() && located.relief_points.empty())
      throw InputError("No building is left to pack: see --report for what was wrong with each of them.");
    resolve_relief(located, settings_.terrain.has_value(), result_.skipped);
    require_ground_below_roofs(located);
    return located;
  }

  void require_ground_below_roofs(const LocatedCity& located) const {
    const auto buildings = located.city.buildings();
    const auto lacks_foot = [](const Building& b) { return b.footing == HeightReference::down_to_ground; };
    if (settings_.terrain || !located.relief_points.empty() || std::none_of(buildings.begin(), buildings.end(), lacks_foot))
      return;
    throw InputError(
        "--roof-field tells where roofs are, but not how far down the buildings reach: give --terrain DEM, or --base-field "
        "NAME where the table knows the ground.");
  }

  /// Buildings decide where the grid lies, and of a terrain only what it covers is read; a terrain alone decides itself.
  std::pair<Grid, std::optional<TerrainRaster>> lay_grid_on_ground(const LocatedCity& located) {
    if (located.city.buildings().empty()) {
      std::optional<TerrainRaster> terrain;
      if (settings_.terrain) terrain = timed("terrain", [&] { return read_ground(located, std::nullopt); });
      const Grid grid = timed("align", [&] { return grid_over(ground_outline(located, terrain), settings_.grid); });
      return {grid, std::move(terrain)};
    }
    const GridAlignment aligned = timed("align", [&] { return align(located, settings_.grid, report_); });
    result_.alignment = aligned.streets;
    if (!settings_.terrain) return {aligned.grid, std::nullopt};
    return {aligned.grid, timed("terrain", [&] { return read_ground(located, city_outline(aligned.grid)); })};
  }

  [[nodiscard]] TerrainRaster read_ground(const LocatedCity& located, const std::optional<Box2d>& wanted_city) const {
    TerrainRaster terrain = read_terrain(*settings_.terrain, settings_.georeference.crs, located.georeference, wanted_city);
    if (std::none_of(terrain.height_m.begin(), terrain.height_m.end(), [](const auto& height) { return height.has_value(); }))
      throw InputError(settings_.terrain->string() + " has no heights where the city lies: give a terrain that covers it.");
    return terrain;
  }

  /// Tries grids, and takes the best into the settings. What is wrong with the city is reported once, when it is packed.
  ChosenGrid choose(const LocatedCity& located) {
    Report unread;
    const auto lay = [&](double cell_edge_m) -> std::pair<Grid, std::optional<TerrainRaster>> {
      GridSettings settings = settings_.grid;
      settings.cell_edge_m = cell_edge_m;
      if (located.city.buildings().empty()) {
        std::optional<TerrainRaster> terrain;
        if (settings_.terrain) terrain = read_ground(located, std::nullopt);
        return {grid_over(ground_outline(located, terrain), settings), std::move(terrain)};
      }
      const Grid grid = align(located, settings, unread).grid;
      return {grid, settings_.terrain ? std::optional(read_ground(located, city_outline(grid))) : std::nullopt};
    };
    const auto best = choose_grid(located, lay, settings_.assign, settings_.far_map.horizon, *settings_.choice);
    if (!best) return {};
    settings_.grid.cell_edge_m = best->cell_edge_m;
    settings_.grid.neighborhood = best->neighborhood;
    settings_.far_map.horizon.tolerance = best->tolerance;
    return {best, {}};
  }

  void estimate(const LocatedCity& located, const Grid& grid, const std::optional<TerrainRaster>& terrain) {
    using oneapi::tbb::global_control;
    const std::size_t threads = global_control::active_value(global_control::max_allowed_parallelism);
    const std::size_t ground_points = terrain ? terrain->height_m.size() : located.relief_points.size();
    result_.estimate = estimate_pack(located.city, ground_points, grid, settings_.far_map.kind, threads);
    require_memory(result_.estimate, settings_.memory_limit_mib);
    if (tell_) tell_(result_.estimate);
  }

  /// What is found here is placed in the CRS of the package.
  TileSet cut_city(LocatedCity located, const Grid& grid, const std::optional<TerrainRaster>& terrain) {
    const std::size_t known = report_.problems().size();
    const Georeference place = located.georeference;
    TileSet tiles = cut_into_tiles(std::move(located), grid, settings_.assign, terrain, report_);
    if (const auto crs = Crs::find(place.crs_wkt)) {
      ProblemLocator locator(*crs, FileAxes{}, place.origin_m);
      for (Problem& problem : report_.since(known)) locator.locate(problem);
    }
    return tiles;
  }

  /// Later stages find no more of them, and take long.
  void require_no_problems() const {
    const std::size_t count = report_.problems().size();
    if (settings_.problems == ProblemPolicy::pack || count == 0) return;
    throw ProblemsRefused("the city has " + std::to_string(count) + (count == 1 ? " problem" : " problems"));
  }

  [[nodiscard]] FarErrorEstimate measure(const TileSet& tiles, const Grid& grid) const {
    FarErrorSettings others = settings_.choice->judge;
    others.seed += 1;
    others.cells *= 2;
    return FarMapTrial(tiles, grid, settings_.assign, others).run(grid.neighborhood, settings_.far_map.horizon);
  }

  void describe_place(const LocatedCity& located, const Grid& grid) {
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
    m.far_map = shape_of(settings_.far_map);
    for (const auto& input : settings_.inputs) m.inputs.push_back(input_file(input));
    if (settings_.terrain) m.inputs.push_back(input_file(terrain_on_disk_.value_or(*settings_.terrain)));
  }

  void describe_tiles(const TileSet& tiles) {
    package::Manifest& m = result_.manifest;
    m.height_origin_m = tiles.height_origin_m;
    m.buildings = tiles.building_ids.size();
    m.polygons = tiles.polygon_count;
    m.triangles = tiles.triangle_count();
    result_.foundations = tiles.foundation_count;
    if (tiles.foundation_count > 0)
      result_.notes.push_back(std::to_string(tiles.foundation_count) +
                              " buildings have their lowest floor above the ground somewhere: it was closed down to the ground.");
    std::map<int, std::uint64_t> counts;
    for (const Problem& p : report_.problems()) ++counts[static_cast<int>(p.code)];
    m.problem_counts.assign(counts.begin(), counts.end());
  }

  void write_package(const TileSet& tiles, const Grid& grid) {
    PackageWriter writer(settings_.output, settings_.overwrite);
    const FarMapBaker baker = timed("city_index", [&] { return FarMapBaker(tiles, grid, settings_.assign, settings_.far_map); });
    const std::vector<Block> blocks = grid.blocks();
    double bake_s = 0.0, write_s = 0.0;
    BakedBlock to_write;
    oneapi::tbb::task_group writing;  // a block is written while the next one is baked
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      progress_("far maps", n, blocks.size());
      const auto start = Clock::now();
      BakedBlock maps = baker.bake(blocks[n]);
      bake_s += seconds_between(start, Clock::now());
      writing.wait();
      to_write = std::move(maps);
      writing.run([&, block = blocks[n]] {
        const auto begin = Clock::now();
        result_.manifest.blocks.push_back(writer.write_block(tiles, to_write, grid, block, result_.manifest.far_map));
        write_s += seconds_between(begin, Clock::now());
      });
    }
    writing.wait();
    progress_("far maps", blocks.size(), blocks.size());
    writer.finish(result_.manifest);
    result_.stage_seconds.emplace_back("far_maps", bake_s);
    result_.stage_seconds.emplace_back("package", write_s);
    result_.package_bytes = writer.bytes_written();
    result_.far_map_bytes = writer.far_map_bytes();
  }

  PackSettings settings_;
  std::optional<std::filesystem::path> terrain_on_disk_;  ///< the archive that it is in, if any
  Report& report_;
  const PackProgress& progress_;
  const TellEstimate& tell_;
  PackResult result_;
};

}  // namespace

PackResult pack(const PackSettings& settings, Report& report, const PackProgress& progress, const TellEstimate& tell) {
  return Packing(settings, report, progress, tell).run();
}

}  // namespace farlod
