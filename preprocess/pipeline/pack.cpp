// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "base/cancellation.hpp"
#include "base/paging/memory_bound.hpp"
#include "base/shard_parts.hpp"
#include "far_terrain/far_terrain.hpp"
#include "farlod/error.hpp"
#include "farmap/far_map_baker.hpp"
#include "georeference/resolved_source.hpp"
#include "package/crowns_of_city.hpp"
#include "package/sources_file.hpp"
#include "pipeline/blocks.hpp"
#include "pipeline/city_looks.hpp"
#include "pipeline/city_reading.hpp"
#include "pipeline/inventories.hpp"
#include "pipeline/own_pixels.hpp"
#include "pipeline/pack_estimate.hpp"
#include "pipeline/pack_target.hpp"
#include "tiles/crowns_on_ground.hpp"

namespace farlod::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

/// What a package says before its city is cut.
package::Manifest manifest_of(const ReadCity& city, const StageSettings& settings, const PackageOrigin& origin) {
  const Georeference& place = city.located.georeference;
  package::Manifest m;
  m.software = origin.software;
  m.crs_wkt = place.crs_wkt;
  m.crs_name = place.crs_name;
  m.epsg = place.epsg;
  m.origin_m = place.origin_m;
  m.convergence = place.convergence;
  m.grid = city.ground.grid;
  m.assign = settings.assign == Assign::clip ? "clip" : "whole";
  m.far_map = shape_of(city.far_map);
  m.inputs = inputs_of(origin);
  m.pixels = own_pixels_of(city);
  Box2d box;
  for (const Point3d& p_city : city.located.city.points()) box.add(place.origin_m + horizontal(p_city));
  if (!box.empty()) m.buildings_projected = box;
  return m;
}

/// A city in tiles, in the memory of this process or as another one has saved it, and what its far maps are baked from.
struct CutCity {
  TileSet tiles;
  std::optional<CityHorizon> horizon;  ///< where it was saved

  CutCity() = default;
  CutCity(TileSet t, std::optional<CityHorizon> h) : tiles(std::move(t)), horizon(std::move(h)) {}
};

/// Runs the stages one after the other, and measures how long each takes.
class Packing {
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
    require_folders_above(settings_.output);
    CityFiles files;
    timed("inputs", [&] {
      files = find_city_files(settings_, report_);
      origin_ = origin_of(settings_, files, origin_of_unfinished(settings_.output));
    });
    PackTarget target = open_target();
    CutCity city = target.saved_city() ? open_saved(target) : cut_anew(target, std::move(files));
    make_blocks_of(city, target);
    if (settings_.part != PackPart::shard) timed("publish", [&] { target.publish(record_); });
    PackedCity& result = record_.result;
    result.package = package::described(result.manifest);
    result.stage_seconds = std::move(seconds_);
    return std::move(result);
  }

 private:
  void timed(const std::string& stage, const std::function<void()>& work) {
    tell(stage, 0, 1);
    throw_if_cancelled(run_.stop);
    const auto start = Clock::now();
    work();
    const double taken_s = seconds_between(start, Clock::now());
    const auto known = std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& entry) { return entry.first == stage; });
    known == seconds_.end() ? (void)seconds_.emplace_back(stage, taken_s) : (void)(known->second += taken_s);
  }

  /// A shard waits for another one that reads the city.
  PackTarget open_target() {
    std::optional<PackTarget> target;
    const auto open = [&] { target.emplace(settings_, origin_, run_.stop); };
    settings_.part == PackPart::shard ? timed("wait", open) : open();
    return std::move(*target);
  }

  CutCity open_saved(const PackTarget& target) {
    record_ = *target.saved_city();
    std::vector<std::string>& notes = record_.result.notes;
    notes.insert(notes.begin(), target.notes().begin(), target.notes().end());
    for (const Problem& problem : record_.problems) report_.add(problem);
    require_no_problems();
    expect_memory();
    std::optional<CutCity> city;
    timed("city_index", [&] {
      auto saved = SavedCity::open(target.city_folder(), record_.result.manifest.grid);
      if (saved) city.emplace(std::move(saved->tiles), std::move(saved->horizon));
    });
    if (!city) throw OutputError(target.city_folder().string() + " was changed by another process: remove it, and pack again.");
    return std::move(*city);
  }

  /// Reads and cuts the city, and plans its blocks.
  CutCity cut_anew(PackTarget& target, CityFiles files) {
    const RunStage run_stage = [this](const std::string& stage, const std::function<void()>& work) { timed(stage, work); };
    std::vector<SourceTrees> inventories;
    if (settings_.trees.any()) timed("trees", [&] { inventories = read_inventories(settings_, report_, run_.stop); });
    ReadCity city = read_city(std::move(files), settings_, report_, run_.stop, run_stage);
    require_unchanged(origin_);
    PackedCity& result = record_.result;
    result.notes = target.notes();
    result.manifest = manifest_of(city, settings_, origin_);
    take_findings(city);
    record_.plan = target.plan(city.located.georeference, result);
    tiles::TreesOfCity trees;
    if (settings_.trees.any()) timed("trees", [&] { trees = trees_at(city, std::move(inventories)); });
    estimate(city, trees);
    CutCity cut;
    std::optional<CrownsOfCity> crowns;
    timed("tiles",
          [&] { cut.tiles = cut_tiles(std::move(city), std::move(trees), target.unfinished().package_folder(), crowns); });
    require_no_problems();
    describe_tiles(cut.tiles);
    write_beside_blocks(target.unfinished().package_folder(), cut.tiles, crowns);
    if (auto without_far_maps = target.plan_of_relief(result)) record_.plan = std::move(*without_far_maps);
    if (target.existing()) timed("compare", [&] { target.require_same_city(cut.tiles, result.manifest); });
    if (result.chosen) timed("measure", [&] { result.chosen->measured = measure(cut.tiles); });
    record_.costs = costs_of(record_.plan, cut.tiles, result.manifest.grid);
    return cut;
  }

  void write_beside_blocks(const std::filesystem::path& folder, TileSet& tiles, std::optional<CrownsOfCity>& crowns) {
    package::Manifest& m = record_.result.manifest;
    m.far_terrain = write_far_terrain(folder, tiles.far_terrain);
    m.sources = write_sources(folder, std::exchange(tiles.sources, {}), sources_);
    if (crowns) timed("crowns", [&] { m.canopy = write_canopy(folder, *crowns); });
  }

  void take_findings(ReadCity& city) {
    sources_ = sources_of(origin_, std::move(city.located.placed));
    PackedCity& result = record_.result;
    result.looks = looks_of(city);
    result.facets = city.located.city.facets().size();
    result.street_bearing = city.ground.streets.bearing;
    result.alignment_strength = city.ground.streets.strength;
    result.skipped = std::move(city.skipped);
    result.notes.insert(result.notes.end(), city.notes.begin(), city.notes.end());
    if (city.is_chosen) result.chosen = ChosenGrid{city.best, {}};
  }

  void estimate(const ReadCity& city, const tiles::TreesOfCity& trees) {
    const CityModel& model = city.located.city;
    const GridOnGround& ground = city.ground;
    const auto threads = static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
    const GroundLoad load =
        ground.terrain ? ground_load_of(*ground.terrain, ground.grid, model.buildings().empty() && squares_of_readers(settings_))
                       : GroundLoad::of_points(city.located.relief_points.size());
    const FarMapKind kind = settings_.far_map.kind;
    const CanopyLoad canopy = canopy_load_of(trees);
    record_.memory = memory_of_pack(model, load, ground.grid, kind, canopy);
    if (!settings_.far_terrains.empty()) record_.memory.always_mib += far_terrain::most_mib;
    const std::uint64_t far_maps = load.is_rough && !settings_.area ? 0 : record_.plan.far_maps;
    record_.result.estimate = estimate_pack(record_.memory, model, load, ground.grid, kind, canopy, threads, far_maps);
    expect_memory();
  }

  void expect_memory() {
    PackEstimate& e = record_.result.estimate;
    // What it took to read the city, it takes again
    e.least_memory_mib = std::max(e.least_memory_mib, static_cast<double>(bound_.most_needed()) / 1048576.0);
    require_memory(e, run_);
    const auto threads = static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
    blocks_at_once_ = record_.memory.blocks_at_once(settings_.area ? threads : usual_blocks_at_once, run_);
    bound_.expect(static_cast<std::uint64_t>(record_.memory.in_memory_mib(blocks_at_once_)) << 20);
    if (on_estimate_) on_estimate_(e);
  }

  tiles::TreesOfCity trees_at(const ReadCity& city, std::vector<SourceTrees> inventories) {
    PackedCity& result = record_.result;
    ReadTrees read =
        bring_to_city(std::move(inventories), settings_, city.located.georeference, city.ground.grid, report_, run_.stop);
    require_unchanged(origin_);
    for (const auto& [what, count] : read.skipped) result.skipped[what] += count;
    result.notes.insert(result.notes.end(), read.notes.begin(), read.notes.end());
    return std::move(read.trees);
  }

  /// The ground beyond the grid; none where no raster may have it.
  FarTerrain far_terrain_around(const Georeference& place, const std::vector<georeference::TerrainFile>& terrain,
                                const std::vector<georeference::TerrainFile>& beyond, const tiles::Ground& ground,
                                double height_origin_m) {
    std::vector<far_terrain::FarTerrainSource> sources;
    // The last tile of the terrain lies on top
    for (auto tile = terrain.rbegin(); tile != terrain.rend(); ++tile)
      sources.push_back({*tile, settings_.terrain_offset_m, true});
    for (const georeference::TerrainFile& file : beyond) sources.push_back({file});
    if (sources.empty()) return {};
    const far_terrain::CityGround city{place, record_.result.manifest.grid, height_origin_m, ground.lowest_m().value_or(0.0),
                                       [&ground](Point2d p) { return ground.height_at(p); }};
    FarTerrain found;
    timed("far_terrain", [&] {
      found = far_terrain::far_terrain_around(sources, settings_.georeference.crs, city, {}, report_, record_.result.notes,
                                              run_.stop);
    });
    double farthest_m = 0.0;
    for (const Point3f& p : found.vertices) farthest_m = std::max(farthest_m, std::hypot(double{p.x}, double{p.y}));
    if (!found.empty())
      record_.result.notes.push_back(
          fmt::format("The terrain beyond the grid may hide the sky, too: {} triangles of it, up to {:.1f} km away.",
                      found.triangles.size(), farthest_m / 1000.0));
    return found;
  }

  /// The problems found here have positions in the CRS of the package.
  TileSet cut_tiles(ReadCity city, tiles::TreesOfCity trees, const std::filesystem::path& folder,
                    std::optional<CrownsOfCity>& crowns) {
    const std::size_t known = report_.problems().size();
    const Georeference place = city.located.georeference;
    FarTerrain far_terrain;
    const tiles::OnGround on_ground = [&](tiles::Ground& ground, double height_origin_m) {
      far_terrain = far_terrain_around(place, city.terrain_files, city.far_terrain_files, ground, height_origin_m);
      std::optional<package::SurfacePixels>& pixels = record_.result.manifest.pixels;
      if (pixels && city.ground.terrain->covers_pixels)
        write_heights(folder, city, ground, height_origin_m, far_terrain.empty() ? squares_of_readers(settings_) : std::nullopt,
                      *pixels);
      const std::uint64_t squares = pixels ? pixels->squares.value_or(0) : 0;
      if (!trees.any()) return squares;
      tiles::CrownPlacing placing(settings_.trees, city.ground.grid, place.origin_m, report_);
      crowns = placing.run(std::move(trees), ground, height_origin_m, run_.stop);
      record_.result.crowns = placing.counts();
      for (const std::string& note : placing.notes()) record_.result.notes.push_back(note);
      return squares;
    };
    TileSet tiles = tiles::cut_into_tiles(std::move(city.located), city.ground.grid, settings_.assign, city.ground.terrain,
                                          report_, run_.stop, on_ground);
    tiles.far_terrain = std::move(far_terrain);
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

  [[nodiscard]] FarErrorEstimate measure(const TileSet& tiles) const {
    FarErrorSettings others = settings_.choice->error_sampling;
    others.seed += 1;
    others.cells *= 2;
    const Grid& grid = record_.result.manifest.grid;
    return FarMapTrial(tiles, grid, settings_.assign, others, run_.stop).run(grid.neighborhood, far_map_settings().horizon);
  }

  void describe_tiles(const TileSet& tiles) {
    PackedCity& result = record_.result;
    package::Manifest& m = result.manifest;
    m.height_origin_m = tiles.height_origin_m;
    m.buildings = tiles.building_ids.size();
    m.polygons = tiles.polygon_count;
    m.triangles = tiles.triangle_count();
    result.foundations = tiles.foundation_count;
    if (tiles.foundation_count > 0)
      result.notes.push_back("Closed down to the ground, since a low floor is above it somewhere: " +
                             std::to_string(tiles.foundation_count) + " of " + std::to_string(tiles.building_ids.size()) +
                             " buildings (usual on slopes; problem 406 has those that are more than 3 m above it).");
    std::map<int, std::uint64_t> counts;
    for (const Problem& p : report_.since(first_problem_)) ++counts[static_cast<int>(p.code)];
    m.problem_counts.assign(counts.begin(), counts.end());
    record_.problems.assign(report_.since(first_problem_).begin(), report_.since(first_problem_).end());
  }

  /// As they were given, or chosen.
  [[nodiscard]] FarMapSettings far_map_settings() const {
    FarMapSettings settings = settings_.far_map;
    if (settings.kind == FarMapKind::horizon) settings.horizon.tolerance = record_.result.manifest.far_map.tolerance;
    return settings;
  }

  void make_blocks_of(CutCity& city, PackTarget& target) {
    PackedCity& result = record_.result;
    const Grid& grid = result.manifest.grid;
    const bool is_shard = settings_.part == PackPart::shard;
    const std::optional<FarMapBaker> baker = baker_of(city, grid);
    if (is_shard && !target.saved_city())
      timed("save", [&] { target.save_city(city.tiles, baker ? baker->horizon() : nullptr, record_, run_.stop); });
    const Shard shard = is_shard ? settings_.shard : Shard{};
    const std::vector<std::size_t> places = parts_of_shard(record_.costs, shard);
    const BlockSource source{city.tiles, grid, result.manifest.far_map, baker ? &*baker : nullptr};
    const BlockTally tally = make_blocks(source, record_.plan, places, target.unfinished(), run_, blocks_at_once_);
    throw_if_cancelled(run_.stop);
    seconds_.emplace_back("far_maps", tally.bake_s);
    seconds_.emplace_back("package", tally.write_s);
    result.blocks = places.size();
    result.blocks_found = tally.found;
    result.far_map_bytes = tally.far_map_bytes;
  }

  /// None where no far map is baked.
  std::optional<FarMapBaker> baker_of(CutCity& city, const Grid& grid) {
    std::optional<FarMapBaker> baker;
    if (record_.plan.far_maps == 0) return baker;
    if (city.horizon) {
      baker.emplace(city.tiles, grid, far_map_settings().horizon, std::move(*city.horizon));
    } else {
      timed("city_index", [&] { baker.emplace(city.tiles, grid, settings_.assign, far_map_settings()); });
      city.tiles.let_go();
    }
    return baker;
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
  PackageOrigin origin_;
  CityRecord record_;
  std::vector<std::optional<SourceOfPackage>> sources_;
  std::vector<std::pair<std::string, double>> seconds_;
};

/// All shards have made their blocks.
PackedCity merge(const StageSettings& settings, Report& report) {
  std::optional<PackageOrigin> origin;
  if (!settings.inputs.empty() || !settings.terrain.empty())
    origin = origin_of(settings, find_city_files(settings, report), origin_of_unfinished(settings.output));
  const auto start = Clock::now();
  auto [target, record] = PackTarget::to_merge(settings, origin);
  for (const Problem& problem : record.problems) report.add(problem);
  target.publish(record);
  PackedCity& result = record.result;
  result.package = package::described(result.manifest);
  result.blocks = result.blocks_found = record.plan.blocks.size();
  result.stage_seconds.emplace_back("publish", seconds_between(start, Clock::now()));
  return std::move(result);
}

}  // namespace

PackedCity pack(const StageSettings& settings, Report& report, const RunSettings& run, const OnEstimate& on_estimate) {
  if (settings.part == PackPart::merge) return merge(settings, report);
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
