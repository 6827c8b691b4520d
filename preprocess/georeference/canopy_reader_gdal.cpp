// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/placed_raster_gdal.hpp"
#include "georeference/raster_reader.hpp"

namespace farlod::georeference {
namespace {

constexpr float no_crown = std::numeric_limits<float>::quiet_NaN();

void bring_into_squares(PlacedRaster& raster, const Crs& own, const Crs& output) {
  const PixelFrame frame = raster.frame();
  WarpWay way{own.wkt(), output.wkt(), "near"};
  if (own.equals(output)) {
    way.step = std::min(norm(frame.column_step), norm(frame.row_step));
    const double columns = raster.file->GetRasterXSize(), rows = raster.file->GetRasterYSize();
    way.extent.emplace();
    for (const double column : {0.0, columns})
      for (const double row : {0.0, rows}) way.extent->add(frame.place(column, row));
  }
  raster.warp(way, output);
  const std::string why = own.equals(output) ? "its pixels are no squares" : "it is in " + own.name();
  raster.note = raster.path.string() + ": since " + why + ", it is read in squares of " +
                length_text(norm(raster.frame().column_step)) + " m, each with the height of the nearest pixel";
}

PlacedRaster open(const std::filesystem::path& path, const std::optional<std::string>& layer) {
  return {path,
          open_height_raster(GdalReach::local_files, path,
                             "is not a raster of the heights of crowns that can be read: give a GeoTIFF, an ESRI ASCII grid or "
                             "another format of GDAL",
                             {layer, false})};
}

PlacedRaster make_ready(const std::filesystem::path& path, const std::optional<std::string>& layer,
                        const std::string& fallback_crs, const Crs& output) {
  PlacedRaster raster = open(path, layer);
  const Crs crs = raster.take_crs(fallback_crs, output);
  if (!crs.equals(output) || !raster.frame().is_made_of_squares()) bring_into_squares(raster, crs, output);
  return raster;
}

/// The pixels that a rectangle meets, and one more at each side.
RasterWindow window_of(const PlacedRaster& raster, const Box2d& wanted) {
  const PixelFrame frame = raster.frame();
  Box2d box;
  for (const Point2d corner :
       {wanted.low, Point2d{wanted.high.x, wanted.low.y}, wanted.high, Point2d{wanted.low.x, wanted.high.y}})
    box.add(frame.pixels_at(corner));
  const auto within = [](double pixel, int count) {
    return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(count)));
  };
  const int columns = raster.columns(), rows = raster.rows();
  return {within(std::floor(box.low.x) - 1.0, columns), within(std::floor(box.low.y) - 1.0, rows),
          within(std::ceil(box.high.x) + 1.0, columns), within(std::ceil(box.high.y) + 1.0, rows)};
}

PagedArray<float> read_heights(const PlacedRaster& raster, const RasterWindow& w, const std::stop_token& stop) {
  PagedArray<float> heights;
  std::vector<double> values(w.columns());
  GDALRasterBand& band = *raster.dataset().GetRasterBand(1);
  for (int row = w.row; row < w.row_end; ++row) {
    throw_if_cancelled(stop);
    if (!read_pixels(band, w.column, row, values)) refuse_raster(raster.path, "cannot be read to its end");
    for (const double value : values) heights.push_back(std::isfinite(value) ? raster.scale.metres(value) : no_crown);
  }
  return heights;
}

bool lie_alike(const PlacedRaster& a, const PlacedRaster& b) {
  const PixelFrame fa = a.frame(), fb = b.frame();
  const double tolerance_m = 1e-3 * norm(fa.column_step);
  const auto is_near = [&](Point2d p, Point2d q) { return norm(p - q) <= tolerance_m; };
  const double columns = a.columns(), rows = a.rows();
  return a.columns() == b.columns() && a.rows() == b.rows() && is_near(fa.corner, fb.corner) &&
         is_near(fa.place(columns, rows), fb.place(columns, rows)) && is_near(fa.place(columns, 0.0), fb.place(columns, 0.0));
}

/// The trunks below each cell that has data: those of the pixel at its centre.
PagedArray<float> trunks_below(const CanopyRaster& canopy, const PlacedRaster& trunks, const Box2d& wanted, Point2d origin_m,
                               const std::stop_token& stop) {
  const RasterWindow w = window_of(trunks, wanted);
  const PagedArray<float> heights = w.is_empty() ? PagedArray<float>() : read_heights(trunks, w, stop);
  const PixelFrame frame = trunks.frame();
  PagedArray<float> below;
  for (std::size_t row = 0; row < canopy.rows; ++row)
    for (std::size_t column = 0; column < canopy.columns; ++column) {
      const Point2d pixel = frame.pixels_at(canopy.centre(column, row) + origin_m) - Point2d{double(w.column), double(w.row)};
      const bool is_within = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < static_cast<double>(w.columns()) &&
                             pixel.y < static_cast<double>(w.rows()) && !w.is_empty();
      below.push_back(is_within ? heights[static_cast<std::size_t>(pixel.y) * w.columns() + static_cast<std::size_t>(pixel.x)]
                                : no_crown);
    }
  return below;
}

CanopyRaster read_tops(const PlacedRaster& tops, const Crs& output, const Box2d& wanted, Point2d origin_m,
                       const std::stop_token& stop) {
  const RasterWindow w = window_of(tops, wanted);
  if (w.is_empty()) refuse_elsewhere(tops.path.string(), tops, output, wanted);
  const PixelFrame frame = tops.frame();
  CanopyRaster canopy;
  canopy.source = tops.path.string();
  canopy.first = frame.place(w.column + 0.5, w.row + 0.5) - origin_m;
  canopy.column_step = frame.column_step;
  canopy.row_step = frame.row_step;
  canopy.columns = w.columns();
  canopy.rows = w.rows();
  canopy.top_m = read_heights(tops, w, stop);
  return canopy;
}

}  // namespace

void require_canopy(const CanopyFiles& files) {
  const GdalErrors quiet;
  (void)open(files.tops, files.layer).frame();
  if (files.trunks) (void)open(*files.trunks, files.layer).frame();
}

std::pair<CanopyRaster, std::vector<std::string>> read_canopy(const CanopyFiles& files, const std::string& fallback_crs,
                                                              const Georeference& georeference, const Box2d& wanted_city,
                                                              const std::stop_token& stop) {
  const GdalErrors quiet;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const Point2d origin_m = georeference.origin_m;
  const Box2d wanted{wanted_city.low + origin_m, wanted_city.high + origin_m};
  const PlacedRaster tops = make_ready(files.tops, files.layer, fallback_crs, *output);
  CanopyRaster canopy = read_tops(tops, *output, wanted, origin_m, stop);
  std::vector<std::string> notes;
  if (tops.is_in_crs_of_city) notes.push_back(note_of_city_crs(tops.path.string(), 1, georeference));
  if (!tops.note.empty()) notes.push_back(tops.note);
  if (auto note = note_of_unit(tops)) notes.push_back(std::move(*note));
  if (!files.trunks) return {std::move(canopy), std::move(notes)};
  const PlacedRaster trunks = make_ready(*files.trunks, files.layer, fallback_crs, *output);
  if (trunks.is_in_crs_of_city) notes.push_back(note_of_city_crs(trunks.path.string(), 1, georeference));
  if (!trunks.note.empty()) notes.push_back(trunks.note);
  if (!lie_alike(tops, trunks))
    notes.push_back(files.trunks->string() + " has another extent or resolution than " + files.tops.string() +
                    ": below each cell of that, the height of the nearest trunk is taken");
  canopy.trunk_m = trunks_below(canopy, trunks, wanted, origin_m, stop);
  return {std::move(canopy), std::move(notes)};
}

}  // namespace farlod::georeference
