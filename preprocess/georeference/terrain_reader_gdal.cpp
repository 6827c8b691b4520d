// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "georeference/crs.hpp"
#include "georeference/height_shift.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/placed_raster_gdal.hpp"
#include "georeference/raster_reader.hpp"
#include "georeference/raster_stand_ins_gdal.hpp"
#include "georeference/resolved_source.hpp"
#include "plausibility/stand_ins.hpp"

namespace farlod::georeference {
namespace {

using plausibility::HeightsOf;

GDALDatasetUniquePtr open_raster(const TerrainFile& file, bool is_city = false) {
  return open_height_raster(
      file.is_named ? GdalReach::local_files : GdalReach::own_data, file.path,
      "is not a raster of heights that can be read: give a GeoTIFF, an ESRI ASCII grid or another format of GDAL; a relief "
      "of CityGML or CityJSON goes among the inputs",
      {file.layer, is_city});
}

/// The pixels, of `count`, whose centres lie between `low` and `high`, and one more at each end. Both are counted in pixels from
/// the edge of the first pixel.
std::pair<int, int> pixels_around(double low, double high, int count) {
  const double begin = std::clamp(std::floor(low - 0.5) - 1.0, 0.0, static_cast<double>(count));
  const double end = std::clamp(std::ceil(high - 0.5) + 2.0, 0.0, static_cast<double>(count));
  return {static_cast<int>(begin), static_cast<int>(end)};
}

RasterWindow window_of(const PlacedRaster& raster, const std::optional<Box2d>& wanted) {
  const int columns = raster.columns(), rows = raster.rows();
  if (!wanted) return {0, 0, columns, rows};
  const PixelFrame frame = raster.frame();
  const Point2d first = frame.pixels_at({wanted->low.x, wanted->high.y}), last = frame.pixels_at({wanted->high.x, wanted->low.y});
  const auto [column, column_end] = pixels_around(first.x, last.x, columns);
  const auto [row, row_end] = pixels_around(first.y, last.y, rows);
  return {column, row, column_end, row_end};
}

/// Masked pixels are empty; nothing when the file is cut short.
std::optional<TerrainRaster> read_window(const PlacedRaster& raster, const RasterWindow& w, Point2d origin) {
  const PixelFrame frame = raster.frame();
  TerrainRaster terrain;
  terrain.columns = w.columns();
  terrain.rows = w.rows();
  terrain.step_m = {frame.column_step.x, -frame.row_step.y};
  // The first row of a file is in the north, that of a terrain in the south
  terrain.first = frame.place(w.column + 0.5, w.row_end - 0.5) - origin;
  terrain.height_m.reserve(terrain.columns * terrain.rows);
  std::vector<double> values(w.columns());
  for (int row = w.row_end - 1; row >= w.row; --row) {
    if (!read_pixels(*raster.dataset().GetRasterBand(1), w.column, row, values)) return std::nullopt;
    for (const double value : values) terrain.height_m.push_back(raster.height_m(value));
  }
  return terrain;
}

/// Walls of a surface model stand between two pixels. Resampled bilinearly they lean over two pixels, which shows up to .014 more
/// sky beside them; resampled to the nearest pixel once, their borders are ragged by half a pixel (up to .018 off the sky above
/// the pixels as blocks); in thirds, .005.
constexpr double squares_per_pixel = 3.0;

void bring_into_fine_squares(PlacedRaster& raster, WarpWay way, const Crs& own, const Crs& output) {
  way.resampling = "near";
  const bool is_turned = own.equals(output);
  if (is_turned) {
    const PixelFrame frame = raster.frame();
    way.step = std::min(norm(frame.column_step), norm(frame.row_step)) / squares_per_pixel;
    way.extent = raster.extent();
  } else {
    raster.warp(way, output);
    way.step = raster.frame().column_step.x / squares_per_pixel;
  }
  raster.warp(way, output);
  raster.note = raster.path.string() + ": since " + (is_turned ? "it is turned" : "it is in " + own.name()) +
                ", it is read in squares of " + length_text(*way.step) + " m, each with the height of the nearest pixel";
}

/// A raster that is north up in the output CRS, and the CRS of its file.
struct ReadyRaster {
  PlacedRaster raster;
  Crs own;
};

/// Stand-ins for no data must not become heights between them and their neighbours.
ReadyRaster make_ready(const TerrainFile& file, const std::string& fallback_crs, const Crs& output, HeightsOf of,
                       Report& report) {
  PlacedRaster raster{file.path, open_raster(file)};
  raster.crs_in_place = file.crs;
  const Crs crs = raster.take_crs(fallback_crs, output);
  const PixelFrame frame = raster.frame();
  const Point2d middle{0.5 * raster.columns(), 0.5 * raster.rows()};
  report_place(file.path.string(), crs, frame.place(middle.x, middle.y), frame.place(middle.x + 1.0, middle.y), report);
  if (!crs.equals(output) || !frame.is_north_up()) {
    WarpWay way{crs.wkt(), output.wkt()};
    clear_stand_ins(raster, of, crs, report);
    if (of == HeightsOf::surfaces)
      bring_into_fine_squares(raster, std::move(way), crs, output);
    else
      raster.warp(way, output);
  }
  return {std::move(raster), crs};
}

/// Empties what is left of heights that no place has. Where the raster was resampled, all was told before.
void require_heights(TerrainRaster& terrain, const PlacedRaster& raster, HeightsOf of, const Crs& output, Point2d origin_m,
                     Report& report) {
  const std::size_t all = terrain.height_m.size();
  const auto stand_ins = plausibility::take_out_stand_ins(terrain.height_m, of);
  require_metres(raster.path.string(), stand_ins, terrain.height_m);
  for (const plausibility::StandIn& found : stand_ins) {
    if (raster.warped) continue;
    const Point2d place = terrain.node(found.first % terrain.columns, found.first / terrain.columns) + origin_m;
    report_stand_in(raster.path.string(), output, {raster.scale.number(found.height_m), place},
                    std::to_string(found.pixels) + " of " + std::to_string(all) + " pixels here, ", report);
  }
}

/// The pixels that have a height, in the CRS of the projection.
std::vector<Point3d> centres_of_row(const PlacedRaster& raster, const PixelFrame& frame, int row, const Projection& projection) {
  std::vector<double> numbers(static_cast<std::size_t>(raster.columns()));
  if (!read_pixels(*raster.dataset().GetRasterBand(1), 0, row, numbers)) refuse_raster(raster.path, "cannot be read to its end");
  std::vector<Point3d> points;
  for (std::size_t column = 0; column < numbers.size(); ++column) {
    const auto height_m = raster.height_m(numbers[column]);
    if (!height_m) continue;
    const Point2d p = frame.place(static_cast<double>(column) + 0.5, row + 0.5);
    points.push_back({p.x, p.y, *height_m});
  }
  projection(points);
  return points;
}

TerrainExtent extent_of(const TerrainFile& file, bool is_city) {
  const GdalErrors quiet;
  const PlacedRaster raster{file.path, open_raster(file, is_city)};
  return {file.crs.value_or(wkt_of(raster.file->GetSpatialRef())), raster.extent(), norm(raster.frame().column_step)};
}

}  // namespace

TerrainExtent read_terrain_extent(const TerrainFile& file) { return extent_of(file, false); }

Georeference georeference_of_terrain(std::span<const TerrainFile> files, const GeoreferenceSettings& settings, Report& report) {
  const std::string name = files.front().path.string();
  TerrainExtent extent = extent_of(files.front(), files.size() == 1);
  for (const TerrainFile& file : files.subspan(1))
    if (const TerrainExtent other = extent_of(file, false); other.crs_wkt == extent.crs_wkt)
      for (const Point2d corner : {other.box.low, other.box.high}) extent.box.add(corner);
  const Crs input = crs_of_input(name, extent.crs_wkt, settings.crs).crs;
  const Point2d centre = 0.5 * (extent.box.low + extent.box.high);
  const Crs output = choose_output_crs(input, centre, settings.out_crs);
  if (!settings.out_crs.empty()) report_output(input, output, centre, report);
  const auto place = input.equals(output) ? centre : CrsTransformation(input, output, centre).apply(centre);
  if (!place) throw InputError(name + ": its centre has no place in " + output.name() + ": check its CRS");
  return georeference_around(*place, output);
}

std::optional<TerrainRaster> find_terrain(const TerrainFile& file, const std::string& fallback_crs,
                                          const Georeference& georeference, std::optional<Box2d> wanted_city, Report& report) {
  const GdalErrors quiet;
  const HeightsOf of = wanted_city ? HeightsOf::ground : HeightsOf::surfaces;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const auto [ready, own] = make_ready(file, fallback_crs, *output, of, report);
  if (wanted_city) *wanted_city = {wanted_city->low + georeference.origin_m, wanted_city->high + georeference.origin_m};
  const RasterWindow window = window_of(ready, wanted_city);
  if (window.is_empty()) return std::nullopt;
  auto terrain = read_window(ready, window, georeference.origin_m);
  if (!terrain) refuse_raster(file.path, "cannot be read to its end");
  require_heights(*terrain, ready, of, *output, georeference.origin_m, report);
  shift_heights(*terrain, file.path.string(), own, georeference, report);
  terrain->is_resampled = ready.warped != nullptr;
  terrain->is_in_crs_of_city = ready.is_in_crs_of_city;
  terrain->note_of_unit = note_of_unit(ready);
  if (!ready.note.empty()) terrain->notes.push_back(ready.note);
  return terrain;
}

std::optional<TurnedSurface> read_turned_surface(const TerrainFile& file, const std::string& fallback_crs,
                                                 const Georeference& georeference, Report& report) {
  const GdalErrors quiet;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  PlacedRaster raster{file.path, open_raster(file, true)};
  raster.crs_in_place = file.crs;
  const Crs own = raster.take_crs(fallback_crs, *output);
  const PixelFrame frame = raster.frame();
  if (own.equals(*output) && frame.is_north_up()) return std::nullopt;
  const Point2d middle{0.5 * raster.columns(), 0.5 * raster.rows()};
  report_place(file.path.string(), own, frame.place(middle.x, middle.y), frame.place(middle.x + 1.0, middle.y), report);
  clear_stand_ins(raster, HeightsOf::surfaces, own, report);
  const Projection projection = make_projection(own, *output, frame.place(middle.x, middle.y));
  TurnedSurface surface;
  for (int row = 0; row < raster.rows(); ++row)
    for (const Point3d& p : centres_of_row(raster, frame, row, projection))
      if (is_on_a_map(p)) surface.points_city.push_back(p - Point3d{georeference.origin_m.x, georeference.origin_m.y, 0.0});
  report_surface(file.path.string(), plausibility::shape_of(surface.points_city), georeference, report);
  surface.notes.push_back(file.path.string() + ": since " + (own.equals(*output) ? "it is turned" : "it is in " + own.name()) +
                          ", the centres of its pixels are brought to " + output->name() +
                          " one by one; slopes stand between them, and no walls");
  if (auto note = note_of_unit(raster)) surface.notes.push_back(std::move(*note));
  return surface;
}

TerrainRaster read_terrain(const TerrainFile& file, const std::string& fallback_crs, const Georeference& georeference,
                           std::optional<Box2d> wanted_city, Report& report) {
  auto terrain = find_terrain(file, fallback_crs, georeference, wanted_city, report);
  if (!terrain) refuse_terrain(file, "", fallback_crs, georeference, *wanted_city);
  return std::move(*terrain);
}

void refuse_terrain(const TerrainFile& file, const std::string& before, const std::string& fallback_crs,
                    const Georeference& georeference, const Box2d& wanted_city) {
  const GdalErrors quiet;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  Report told_before;
  const PlacedRaster raster = make_ready(file, fallback_crs, *output, HeightsOf::ground, told_before).raster;
  refuse_elsewhere(
      before + file.path.string() + (file.is_input ? ", a raster that is taken for the terrain of the buildings," : ""), raster,
      *output, {wanted_city.low + georeference.origin_m, wanted_city.high + georeference.origin_m});
}

}  // namespace farlod::georeference
