// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/studied_city.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "align/align.hpp"
#include "farlod/box.hpp"
#include "georeference/georeference.hpp"
#include "ingest/ingest.hpp"
#include "tests/scenes/generated_town.hpp"

namespace farlod::validation {
namespace {

void move_middle_to_origin(CityModel& city) {
  Box2d outline;
  for (const Point3d& p : city.points()) outline.add(horizontal(p));
  const Point2d middle = 0.5 * (outline.low + outline.high);
  for (Point3d& p : city.points()) p = p - Point3d{middle.x, middle.y, 0.0};
}

/// What farlod-city is asked for, as options of its command line and as settings.
struct GeneratedModel {
  const char* options;
  void (*choose)(CitySettings&);
};
constexpr GeneratedModel generated_model_kinds[] = {
    {"--open-shells", [](CitySettings& s) { s.open_shells = true; }},
    {"--eaves 0.6", [](CitySettings& s) { s.eaves_m = 0.6; }},
    {"--balconies", [](CitySettings& s) { s.balconies = true; }},
    {"--projecting-floors", [](CitySettings& s) { s.projecting_floors = true; }},
    {"--hillside", [](CitySettings& s) { s.lod = 1, s.hillside = true; }},
    {"--overlapping-parts", [](CitySettings& s) { s.overlapping_parts = true; }},
    {"--wrong-bases 0.1 --terrain-relief 40", [](CitySettings& s) { s.wrong_base_share = 0.1, s.terrain_relief_m = 40.0; }},
    {"--overhangs --terrain-relief 100", [](CitySettings& s) { s.overhangs = true, s.terrain_relief_m = 100.0; }},
};

}  // namespace

StudiedCity generated_city(double size_m) {
  CitySettings settings;
  settings.size_m = size_m;
  settings.tower_share = 0.3;
  settings.rotation_deg = 20;
  return {"generated", scenes::generated_town(settings), Angle::degrees(settings.rotation_deg)};
}

std::vector<StudiedCity> generated_models(double size_m) {
  std::vector<StudiedCity> models;
  for (const GeneratedModel& model : generated_model_kinds) {
    CitySettings settings;
    settings.size_m = size_m;
    settings.seed = 9;
    settings.lod = 2;
    model.choose(settings);
    models.push_back({std::string("`") + model.options + "`", scenes::generated_town(settings), Angle()});
  }
  return models;
}

StudiedCity building_city(const std::string& name, const std::filesystem::path& file) { return footprint_city(name, file, ""); }

StudiedCity footprint_city(const std::string& name, const std::filesystem::path& file, const std::string& height_field) {
  Report report;
  ingest::IngestSettings ingest_settings;
  if (!height_field.empty()) ingest_settings.footprints.height_field = height_field;
  std::vector<SourceCity> sources;
  sources.push_back(ingest::ingest(file, ingest_settings, report));
  LocatedCity located = georeference::georeference(std::move(sources), {}, report);
  move_middle_to_origin(located.city);
  const Angle streets = align::street_alignment(located.city).bearing;
  return {name, std::move(located.city), streets};
}

namespace {

Grid with_neighborhood(Grid grid, int neighborhood) {
  grid.neighborhood = neighborhood;
  return grid;
}

}  // namespace

CutCity cut(const StudiedCity& city, Angle bearing, double cell_edge_m, int block_edge) {
  Report report;
  const Grid grid = scenes::grid_covering(city.city, bearing, cell_edge_m, 1, block_edge);
  return {grid, tiles::cut_into_tiles({city.city, {}}, grid, Assign::clip, std::nullopt, report)};
}

FarMapSettings of_kind(FarMapKind kind) {
  FarMapSettings settings;
  settings.kind = kind;
  return settings;
}

SitePackage::SitePackage(const CutCity& cut, int neighborhood, const FarMapSettings& far_map, const scenes::ChosenCells& only)
    : cost_(scenes::pack_tiles(cut.tiles, with_neighborhood(cut.grid, neighborhood), folder_.path() / "city.farlod", far_map,
                               Assign::clip, only)),
      package_(folder_.path() / "city.farlod") {}

double SitePackage::bytes_a_cell() const {
  return static_cast<double>(cost_.bytes_of_whole_blocks) /
         static_cast<double>(std::max<std::size_t>(1, cost_.cells_of_whole_blocks));
}

SitePackage without_far_maps(const CutCity& cut) { return {cut, 1, of_kind(FarMapKind::box), std::vector<Cell>{}}; }

}  // namespace farlod::validation
