// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "city/input_error.hpp"
#include "farlod/version.hpp"
#include "georeference/problem_locator.hpp"
#include "georeference/terrain_reader.hpp"
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
    estimate(located.city, grid, terrain);
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
  LocatedCity read_and_locate() {
    if (settings_.inputs.empty()) {
      return {{}, timed("georeference", [&] { return georeference_of_terrain(*settings_.terrain, settings_.georeference); })};
    }
    std::vector<SourceCity> sources = timed("ingest", [&] {
      std::vector<SourceCity> read;
      for (const auto& input : settings_.inputs) read.push_back(ingest(input, settings_.ingest, report_));
      return read;
    });
    LocatedCity located =
        timed("georeference", [&] { return georeference(std::move(sources), settings_.georeference, report_); });
    if (located.city.buildings().empty())
      throw InputError("No building is left to pack: see --report for what was wrong with each of them.");
    return located;
  }

  /// Buildings decide where the grid lies, and of a terrain only what it covers is read; a terrain alone decides itself.
  std::pair<Grid, std::optional<TerrainRaster>> lay_grid_on_ground(const LocatedCity& located) {
    const auto read = [&](const std::optional<Box2d>& wanted_city) {
      return timed("terrain", [&] { return read_ground(located, wanted_city); });
    };
    if (located.city.buildings().empty()) {
      TerrainRaster terrain = read(std::nullopt);
      const Grid grid = timed("align", [&] { return grid_over(outline_of(terrain), settings_.grid); });
      return {grid, std::move(terrain)};
    }
    const GridAlignment aligned = timed("align", [&] { return align(located, settings_.grid, report_); });
    result_.alignment = aligned.streets;
    return {aligned.grid, settings_.terrain ? std::optional(read(city_outline(aligned.grid))) : std::nullopt};
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
        TerrainRaster terrain = read_ground(located, std::nullopt);
        return {grid_over(outline_of(terrain), settings), std::move(terrain)};
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

  void estimate(const CityModel& city, const Grid& grid, const std::optional<TerrainRaster>& terrain) {
    using oneapi::tbb::global_control;
    const std::size_t threads = global_control::active_value(global_control::max_allowed_parallelism);
    result_.estimate = estimate_pack(city, terrain, grid, settings_.far_map.kind, threads);
    require_memory(result_.estimate, settings_.memory_limit_mib);
    if (tell_) tell_(result_.estimate);
  }

  /// What is found here is placed in the CRS of the package.
  TileSet cut_city(LocatedCity located, const Grid& grid, const std::optional<TerrainRaster>& terrain) {
    const std::size_t known = report_.problems().size();
    const Georeference place = located.georeference;
    TileSet tiles = cut_into_tiles(std::move(located), grid, settings_.assign, terrain, report_);
    if (const auto crs = Crs::find(place.crs_wkt)) {
      ProblemLocator locator(*crs, AxisOrder::as_usual, place.origin_m);
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

  [[nodiscard]] FarMapVerdict measure(const TileSet& tiles, const Grid& grid) const {
    JudgeSettings others = settings_.choice->judge;
    others.seed += 1;
    others.cells *= 2;
    return judge_far_maps(tiles, grid, settings_.far_map.horizon, others);
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
    if (settings_.terrain) m.inputs.push_back(input_file(*settings_.terrain));
  }

  void describe_tiles(const TileSet& tiles) {
    package::Manifest& m = result_.manifest;
    m.height_origin_m = tiles.height_origin_m;
    m.buildings = tiles.building_ids.size();
    m.polygons = tiles.polygon_count;
    m.triangles = tiles.triangle_count();
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
