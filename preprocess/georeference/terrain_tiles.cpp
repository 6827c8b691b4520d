// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "farlod/error.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/raster_reader.hpp"
#include "georeference/resolved_source.hpp"
#include "plausibility/terrain_seams.hpp"

namespace farlod::georeference {
namespace {

/// Nodes that are nearer to each other than this part of a step are the same.
constexpr double same_node = 1e-3;

bool is_whole(double steps) { return std::abs(steps - std::round(steps)) < same_node; }

/// The finest net, over all tiles.
TerrainRaster net_over(const std::vector<TerrainRaster>& tiles) {
  const TerrainRaster& finest = *std::min_element(tiles.begin(), tiles.end(), [](const TerrainRaster& a, const TerrainRaster& b) {
    return a.step_m.x * a.step_m.y < b.step_m.x * b.step_m.y;
  });
  Box2d box;
  for (const TerrainRaster& tile : tiles) {
    box.add(tile.first);
    box.add(tile.node(tile.columns - 1, tile.rows - 1));
  }
  const auto steps = [](double length, double step) { return std::ceil(length / step - same_node); };
  TerrainRaster net;
  net.step_m = finest.step_m;
  net.first = {finest.first.x - steps(finest.first.x - box.low.x, net.step_m.x) * net.step_m.x,
               finest.first.y - steps(finest.first.y - box.low.y, net.step_m.y) * net.step_m.y};
  net.columns = static_cast<std::size_t>(steps(box.high.x - net.first.x, net.step_m.x)) + 1;
  net.rows = static_cast<std::size_t>(steps(box.high.y - net.first.y, net.step_m.y)) + 1;
  net.height_m.resize(net.columns * net.rows);
  return net;
}

/// What is a node of the tile is copied, and what is between them interpolated. No data covers nothing.
void lay_upon(TerrainRaster& net, const TerrainRaster& tile) {
  const double across = (tile.first.x - net.first.x) / net.step_m.x, up = (tile.first.y - net.first.y) / net.step_m.y;
  const bool is_same = std::abs(tile.step_m.x / net.step_m.x - 1.0) * static_cast<double>(tile.columns) < same_node &&
                       std::abs(tile.step_m.y / net.step_m.y - 1.0) * static_cast<double>(tile.rows) < same_node &&
                       is_whole(across) && is_whole(up);
  const auto within = [](double n, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(n, 0.0, static_cast<double>(count)));
  };
  const double width = static_cast<double>(tile.columns - 1) * tile.step_m.x / net.step_m.x,
               height = static_cast<double>(tile.rows - 1) * tile.step_m.y / net.step_m.y;
  const std::size_t left = within(std::ceil(across - same_node), net.columns),
                    right = within(std::floor(across + width + same_node) + 1.0, net.columns),
                    low = within(std::ceil(up - same_node), net.rows),
                    high = within(std::floor(up + height + same_node) + 1.0, net.rows);
  for (std::size_t row = low; row < high; ++row)
    for (std::size_t column = left; column < right; ++column) {
      const auto found = is_same ? tile.height_m[(row - low) * tile.columns + (column - left)]
                                 : std::optional<float>(tile.height_at(net.node(column, row)));
      if (found) net.height_m[row * net.columns + column] = found;
    }
}

/// A whole tile of a terrain that is doubted.
void report_tile(ProblemCode code, const TerrainFile& file, const TerrainRaster& tile, const Georeference& georeference,
                 std::string detail, Report& report) {
  const Point2d place = tile.node(tile.columns / 2, tile.rows / 2);
  report_whole_file(code, file.path.string(), std::move(detail), {place.x, place.y, 0.0}, georeference, report);
}

std::string detail_of_seam(double step_m, const TerrainFile& below) {
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << "where it meets " << below.path.string() << ", it is " << std::abs(step_m) << " m "
       << (step_m > 0.0 ? "above" : "below") << " that: do both count in the same unit, from the same datum?";
  return std::move(text).str();
}

/// Tiles of one terrain must agree where they meet.
void compare_tiles(std::vector<TerrainRaster>& tiles, const std::vector<TerrainFile>& files, const Georeference& georeference,
                   Report& report) {
  for (const std::size_t n : plausibility::blank_tiles(tiles)) {
    report_tile(ProblemCode::undeclared_no_data, files[n], tiles[n], georeference,
                "it holds one number alone, which is no height beside the other tiles, and counts as no data", report);
    std::fill(tiles[n].height_m.begin(), tiles[n].height_m.end(), std::nullopt);
  }
  for (std::size_t n = 1; n < tiles.size(); ++n)
    for (std::size_t k = 0; k < n; ++k) {
      const auto seam = plausibility::seam_between(tiles[k], tiles[n]);
      if (!seam) continue;
      const std::string detail = detail_of_seam(seam->step_m, files[k]);
      if (seam->is_impossible) throw InputError(files[n].path.string() + ": " + detail);
      report_tile(ProblemCode::another_datum, files[n], tiles[n], georeference, detail, report);
    }
}

}  // namespace

void take_crs_of_inputs(std::span<TerrainFile> files, const GeoreferenceSettings& settings, Report& report) {
  if (settings.crs.empty()) return;
  std::vector<SourceCity> sources;
  std::vector<TerrainExtent> extents;
  for (const TerrainFile& file : files) {
    extents.push_back(read_terrain_extent(file));
    SourceCity& source = sources.emplace_back();
    source.source = file.path.string();
    source.crs = {.definition = extents.back().crs_wkt, .longitude_first = true};
  }
  const std::vector<InputCrs> inputs = crs_of_inputs(sources, settings);
  for (std::size_t n = 0; n < files.size(); ++n) {
    const Point2d middle = 0.5 * (extents[n].box.low + extents[n].box.high);
    if (is_overruled(sources[n].source, inputs[n], middle, extents[n].pixel, report)) files[n].crs = settings.crs;
  }
}

std::string heights_of_terrain(const TerrainFile& file) {
  const auto own = find_crs(read_terrain_extent(file).crs_wkt);
  return own && own->crs.heights_name() ? own->crs.whole_wkt() : "";
}

TerrainRaster merged(const std::vector<TerrainRaster>& tiles) {
  TerrainRaster net = net_over(tiles);
  for (const TerrainRaster& tile : tiles) {
    lay_upon(net, tile);
    net.is_resampled |= tile.is_resampled;
    net.is_in_crs_of_city |= tile.is_in_crs_of_city;
    if (!net.note_of_unit) net.note_of_unit = tile.note_of_unit;
    net.notes.insert(net.notes.end(), tile.notes.begin(), tile.notes.end());
  }
  return net;
}

namespace {

TerrainRaster read_tiles(std::span<const TerrainFile> files, const std::string& fallback_crs, Georeference georeference,
                         const std::optional<Box2d>& wanted_city, Report& report) {
  if (files.size() == 1) return read_terrain(files.front(), fallback_crs, georeference, wanted_city, report);
  std::vector<TerrainRaster> tiles;
  std::vector<TerrainFile> files_here;
  for (const TerrainFile& file : files) {
    auto tile = find_terrain(file, fallback_crs, georeference, wanted_city, report);
    if (!tile) continue;
    tiles.push_back(std::move(*tile));
    files_here.push_back(file);
    if (georeference.heights_wkt.empty()) georeference.heights_wkt = heights_of_terrain(file);
  }
  if (tiles.empty())
    refuse_terrain(files.front(),
                   "none of the " + std::to_string(files.size()) + " files of --terrain meets the city: the first, ",
                   fallback_crs, georeference, *wanted_city);
  compare_tiles(tiles, files_here, georeference, report);
  return merged(tiles);
}

}  // namespace

TerrainRaster read_terrain(std::span<const TerrainFile> files, const std::string& fallback_crs, const Georeference& georeference,
                           const std::optional<Box2d>& wanted_city, Report& report) {
  TerrainRaster terrain = read_tiles(files, fallback_crs, georeference, wanted_city, report);
  terrain.source = files.front().path.string();
  if (terrain.is_in_crs_of_city) terrain.notes.push_back(note_of_city_crs(terrain.source, files.size(), georeference));
  if (terrain.note_of_unit) terrain.notes.push_back(*terrain.note_of_unit);
  if (!wanted_city) report_surface(files.front().path.string(), plausibility::shape_of(terrain), georeference, report);
  return terrain;
}

}  // namespace farlod::georeference
