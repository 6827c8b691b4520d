// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/city_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <system_error>
#include <utility>

#include "base/cancellation.hpp"
#include "base/grid_outline.hpp"
#include "base/unread_file.hpp"
#include "city/geometry.hpp"
#include "farlod/error.hpp"
#include "georeference/georeference.hpp"
#include "georeference/resolved_source.hpp"
#include "ingest/files/file_format.hpp"
#include "tiles/pixel_steps.hpp"

namespace farlod::pipeline {
namespace {

Box2d outline_of(const TerrainRaster& terrain) {
  Box2d outline;
  // Others end at the centres of the outermost pixels
  const Point2d half = terrain.covers_pixels ? 0.5 * terrain.step_m : Point2d();
  outline.add(terrain.first - half);
  outline.add(terrain.node(terrain.columns - 1, terrain.rows - 1) + half);
  return outline;
}

Box2d outline_of(std::span<const Point3d> points) {
  Box2d outline;
  for (const Point3d& p : points) outline.add(horizontal(p));
  return outline;
}

/// The share of a box for which the raster has heights, by places that lie evenly in it.
double covered_share(const TerrainRaster& terrain, const Box2d& box) {
  constexpr int side = 64;
  int covered = 0;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      covered += terrain.height_at({std::lerp(box.low.x, box.high.x, (column + 0.5) / side),
                                    std::lerp(box.low.y, box.high.y, (row + 0.5) / side)})
                     ? 1
                     : 0;
  return static_cast<double>(covered) / (side * side);
}

/// The outline of a city without buildings: that of its terrain or relief.
Box2d ground_outline(const LocatedCity& located, const std::optional<TerrainRaster>& terrain) {
  return terrain ? outline_of(*terrain) : outline_of(located.relief_points);
}

void require_one_raster(const std::vector<ingest::InputFile>& surface_models, const std::vector<std::filesystem::path>& terrain) {
  const std::string& first = surface_models.front().name;
  if (surface_models.size() > 1)
    throw InputError(first + " and " + surface_models[1].name +
                     " are both rasters of heights: give one of them, or their mosaic.");
  if (!terrain.empty())
    throw InputError(first + " is a raster of heights, and so is --terrain " + terrain.front().string() +
                     ": give one of them; a surface model shows its ground itself.");
}

void require_ground_below_roofs(const CityModel& city) {
  const auto buildings = city.buildings();
  const auto lacks_foot = [](const Building& b) { return b.height_reference == HeightReference::down_to_ground; };
  if (std::none_of(buildings.begin(), buildings.end(), lacks_foot)) return;
  throw InputError(
      "--roof-field tells where roofs are, but not how far down the buildings reach: give --terrain DEM, or --base-field "
      "NAME where the table knows the ground.");
}

/// Runs the stages from files to a grid over the city.
class CityReading {
 public:
  CityReading(CityFiles files, const StageSettings& settings, Report& report, const std::stop_token& stop,
              const RunStage& run_stage)
      : files_(std::move(files)), settings_(settings), report_(report), stop_(stop), run_stage_(run_stage) {
    read_.far_map = settings.far_map;
    read_.skipped = std::move(files_.skipped);
    for (const georeference::TerrainFile& raster : files_.terrain.files)
      if (raster.is_input)
        read_.notes.push_back(raster.path.string() +
                              " is a raster beside buildings, and is taken for the terrain that they stand on, as --terrain is");
  }

  ReadCity run() {
    std::vector<SourceCity> sources;
    if (!files_.files.empty()) run_stage_("ingest", [&] { sources = ingest(); });
    if (settings_.surface == SurfaceReading::tin && !sources.empty())
      read_.notes.emplace_back("--surface is for a raster that is the city, and changes nothing here");
    run_stage_("georeference", [&] { locate(std::move(sources)); });
    require_usable();
    const align::GridSettings grid = choose_settings();
    read_.ground = lay_grid(grid, report_, run_stage_);
    // The grid of a terrain alone covers all of it
    if (!read_.located.city.buildings().empty()) read_.terrain_files = std::move(files_.terrain.files);
    read_.far_terrain_files = std::move(files_.far_terrain.files);
    if (const auto& terrain = read_.ground.terrain) {
      read_.notes.insert(read_.notes.end(), terrain->notes.begin(), terrain->notes.end());
      if (!read_.located.city.buildings().empty()) note_share(*terrain);
    }
    return std::move(read_);
  }

 private:
  void note_unmet_names(const std::vector<SourceCity>& sources) {
    for (const std::string& name : settings_.ingest.ground_names)
      if (std::none_of(sources.begin(), sources.end(), [&](const SourceCity& source) {
            return std::find(source.met_ground_names.begin(), source.met_ground_names.end(), name) !=
                   source.met_ground_names.end();
          }))
        read_.notes.push_back("nothing is called " + name + ", as --ground-names says, in any mesh");
  }

  std::vector<SourceCity> ingest() {
    std::vector<SourceCity> sources = ingest::ingest_all(files_.files, settings_.ingest, report_, stop_);
    note_unmet_names(sources);
    for (SourceCity& source : sources) {
      for (const auto& [what, count] : source.skipped) read_.skipped[what] += count;
      std::move(source.notes.begin(), source.notes.end(), std::back_inserter(read_.notes));
    }
    return sources;
  }

  /// The ground around the buildings is what a map shows unless another box is asked for. A rim that is missing is not worth a
  /// word.
  void note_share(const TerrainRaster& terrain) {
    constexpr double around_m = 50.0, all_but_a_rim = 0.95;
    const double share = covered_share(terrain, grown(outline_of(std::as_const(read_.located.city).points()), around_m));
    if (share >= all_but_a_rim) return;
    const std::size_t all = read_.located.city.buildings().size(), on_it = count_buildings_on(terrain);
    const std::string below = on_it == all ? "all buildings" : fmt::format("{} of {} buildings", on_it, all);
    read_.notes.push_back(fmt::format(
        "The terrain has heights under {}, and for {:.0f} % of the box around them; elsewhere the ground is as high as the "
        "nearest of them{}",
        below, 100.0 * share, on_it == all ? "" : ": --terrain takes several files"));
  }
  [[nodiscard]] std::size_t count_buildings_on(const TerrainRaster& terrain) const {
    std::size_t count = 0;
    const CityModel& city = read_.located.city;
    city.for_each_building([&](std::size_t, const Building& b) {
      const Box2d outline = outline_of(city.points_of(b));
      if (!outline.empty() && terrain.height_at(0.5 * (outline.low + outline.high))) ++count;
    });
    return count;
  }

  void locate(std::vector<SourceCity> sources) {
    georeference::GeoreferenceSettings settings = settings_.georeference;
    if (sources.empty()) {
      georeference::take_crs_of_inputs(files_.terrain.files, settings, report_);
      read_.located = {{}, georeference::georeference_of_terrain(files_.terrain.files, settings, report_)};
      take_turned_surface();
      return;
    }
    settings.crs_is_for_another |= std::any_of(files_.terrain.files.begin(), files_.terrain.files.end(), [](const auto& tile) {
      return georeference::read_terrain_extent(tile).crs_wkt.empty();
    });
    read_.located = georeference::georeference(std::move(sources), settings, report_);
    std::move(read_.located.notes.begin(), read_.located.notes.end(), std::back_inserter(read_.notes));
    const LocatedCity& located = read_.located;
    if (located.city.buildings().empty())
      georeference::report_surface(located.sources.front(), plausibility::shape_of(located.relief_points), located.georeference,
                                   report_);
  }

  /// Its points are read like those of a relief.
  void take_turned_surface() {
    if (files_.terrain.files.size() != 1) return;
    auto surface = georeference::read_turned_surface(files_.terrain.files.front(), settings_.georeference.crs,
                                                     read_.located.georeference, report_);
    if (!surface) return;
    if (surface->points_city.empty())
      throw InputError(files_.terrain.files.front().path.string() + " has no heights: give a surface model that has some.");
    for (Point3d& p : surface->points_city) p.z += settings_.terrain_offset_m;
    read_.located.relief_points = std::move(surface->points_city);
    std::move(surface->notes.begin(), surface->notes.end(), std::back_inserter(read_.notes));
    files_.terrain.files.clear();
  }

  void require_usable() {
    if (files_.files.empty()) return;
    if (read_.located.city.buildings().empty() && read_.located.relief_points.empty())
      throw InputError("No building is left to pack: see --report for what was wrong with each of them.");
    resolve_relief();
    if (files_.terrain.files.empty() && read_.located.relief_points.empty()) require_ground_below_roofs(read_.located.city);
  }

  /// Drops a relief that is not used: a raster replaces it, or it lies elsewhere than the city. Counts its points as skipped.
  void resolve_relief() {
    LocatedCity& located = read_.located;
    if (located.relief_points.empty()) return;
    const bool is_elsewhere = !located.city.buildings().empty() &&
                              !boxes_meet(outline_of(located.relief_points), outline_of(std::as_const(located.city).points()));
    if (files_.terrain.files.empty() && !is_elsewhere) return;
    const char* reason = !files_.terrain.files.empty() ? " (the raster stands in for them)" : " (none lies where the city is)";
    read_.skipped[std::string("points of reliefs") + reason] += located.relief_points.size();
    located.relief_points.clear();
  }

  [[nodiscard]] align::GridSettings choose_settings() {
    align::GridSettings settings = settings_.grid;
    if (!settings_.choice) return settings;
    run_stage_("choice", [&] { read_.best = choose(*settings_.choice); });
    read_.is_chosen = true;
    if (!read_.best) return settings;
    settings.cell_edge_m = read_.best->cell_edge_m;
    settings.neighborhood = read_.best->neighborhood;
    read_.far_map.horizon.tolerance = read_.best->tolerance;
    return settings;
  }

  /// Tries grids. What is wrong with the city is reported once, when it is packed.
  [[nodiscard]] std::optional<GridChoice> choose(const ChoiceSettings& choice) const {
    Report unread;
    const RunStage run_untimed = [](const std::string&, const std::function<void()>& work) { work(); };
    const auto lay = [&](double cell_edge_m) {
      align::GridSettings settings = settings_.grid;
      settings.cell_edge_m = cell_edge_m;
      GridOnGround ground = lay_grid(settings, unread, run_untimed);
      return std::pair(ground.grid, std::move(ground.terrain));
    };
    return choose_grid(read_.located, lay, settings_.assign, settings_.far_map.horizon, choice, stop_);
  }

  /// Buildings decide where the grid lies, and of a terrain only what it covers is read; a terrain alone decides itself.
  [[nodiscard]] GridOnGround lay_grid(const align::GridSettings& settings, Report& report, const RunStage& run_stage) const {
    std::optional<TerrainRaster> terrain;
    const auto read = [&](const std::optional<Box2d>& wanted_city) {
      if (!files_.terrain.files.empty()) run_stage("terrain", [&] { terrain = read_ground(wanted_city, report); });
    };
    if (read_.located.city.buildings().empty()) {
      read(std::nullopt);
      if (terrain) find_walls(*terrain);
      Grid grid;
      run_stage("align", [&] { grid = align::grid_over(ground_outline(read_.located, terrain), settings); });
      return {grid, std::move(terrain)};
    }
    align::GridAlignment aligned;
    run_stage("align", [&] { aligned = align::align(read_.located, settings, report); });
    read(outline_city(aligned.grid));
    return {aligned.grid, std::move(terrain), aligned.streets};
  }

  [[nodiscard]] TerrainRaster read_ground(const std::optional<Box2d>& wanted_city, Report& report) const {
    TerrainRaster terrain = georeference::read_terrain(std::span(files_.terrain.files), settings_.georeference.crs,
                                                       read_.located.georeference, wanted_city, report);
    if (std::none_of(terrain.height_m.begin(), terrain.height_m.end(), [](const auto& height) { return height.has_value(); }))
      throw InputError(files_.terrain.files.front().path.string() +
                       " has no heights where the city lies: give a terrain that covers it.");
    for (auto& height_m : terrain.height_m)
      if (height_m) *height_m += static_cast<float>(settings_.terrain_offset_m);
    terrain.offset_m = settings_.terrain_offset_m;
    return terrain;
  }

  /// Decides by the data what stands between the pixels of a surface model, and says so.
  void find_walls(TerrainRaster& surface) const {
    if (settings_.surface == SurfaceReading::tin) return;
    const std::string name = files_.terrain.files.front().path.string();
    if (std::max(surface.step_m.x, surface.step_m.y) > tiles::widest_pixel_with_walls_m) return;
    const std::size_t steps = tiles::PixelSteps(surface).count();
    surface.covers_pixels = steps > 0 || !surface.is_resampled;
    if (steps > 0)
      surface.notes.push_back(name + ": walls stand on " + std::to_string(steps) +
                              " sides of pixels whose neighbors are a step apart; --surface tin makes them slopes");
  }

  CityFiles files_;
  const StageSettings& settings_;
  Report& report_;
  const std::stop_token& stop_;
  const RunStage& run_stage_;
  ReadCity read_;
};

}  // namespace

namespace {

/// The rasters in a folder, by name. A folder may be a raster itself (ESRI's grids).
std::vector<std::filesystem::path> rasters_in(const std::filesystem::path& folder) {
  const auto is_raster = [](const std::filesystem::path& path) {
    ingest::InputFile file(path);
    file.is_named = false;
    return ingest::map_kind_of(file) == ingest::MapKind::raster;
  };
  std::vector<std::filesystem::path> rasters;
  if (is_raster(folder)) return {folder};
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code vanished;
    if (entry->is_regular_file(vanished) && is_raster(entry->path())) rasters.push_back(entry->path());
  }
  std::sort(rasters.begin(), rasters.end());
  if (rasters.empty()) throw InputError(folder.string() + " holds no raster of heights that can be read: give files.");
  return rasters;
}

/// The rasters of folders stand for these.
TerrainTiles tiles_of(const std::vector<std::filesystem::path>& given) {
  TerrainTiles tiles;
  std::error_code unread;
  for (const std::filesystem::path& path : given) {
    if (!std::filesystem::exists(path, unread)) throw InputError(why_unread(path));
    const bool is_folder = std::filesystem::is_directory(path, unread);
    for (const std::filesystem::path& tile : is_folder ? rasters_in(path) : std::vector{path}) {
      tiles.files.emplace_back(tile, !is_folder);
      tiles.on_disk.push_back(tile);
    }
  }
  return tiles;
}

}  // namespace

CityFiles find_city_files(const StageSettings& settings, Report& report) {
  const std::optional<std::string>& layer = settings.ingest.footprints.layer;
  CityFiles city;
  city.terrain = tiles_of(settings.terrain);
  city.far_terrain = tiles_of(settings.far_terrains);
  const auto name_layer = [&] {
    for (georeference::TerrainFile& tile : city.terrain.files) tile.layer = layer;
  };
  name_layer();
  if (settings.inputs.empty()) return city;
  ingest::FoundInputs found = ingest::find_input_files(settings.inputs, report, layer);
  if (!found.surface_models.empty()) {
    require_one_raster(found.surface_models, settings.terrain);
    const ingest::InputFile& model = found.surface_models.front();
    city.terrain.files.emplace_back(model.path, model.is_named);
    city.terrain.on_disk.push_back(model.on_disk);
    city.terrain.files.back().is_input = !found.files.empty();
    name_layer();
  }
  for (const ingest::InputFile& file : found.files) city.on_disk.push_back(file.on_disk);
  city.on_disk.erase(std::unique(city.on_disk.begin(), city.on_disk.end()), city.on_disk.end());
  city.files = std::move(found.files);
  city.skipped = std::move(found.skipped);
  return city;
}

ReadCity read_city(CityFiles files, const StageSettings& settings, Report& report, const std::stop_token& stop,
                   const RunStage& run_stage) {
  return CityReading(std::move(files), settings, report, stop, run_stage).run();
}

}  // namespace farlod::pipeline
