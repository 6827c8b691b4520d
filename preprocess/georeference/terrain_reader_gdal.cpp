// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "georeference/crs.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/output_crs.hpp"
#include "georeference/terrain_reader.hpp"

namespace farlod::georeference {
namespace {

GDALDatasetUniquePtr open_raster(const TerrainFile& file) {
  return open_height_raster(
      file.is_named ? GdalReach::local_files : GdalReach::own_data, file.path,
      "is not a raster of heights that can be read: give a GeoTIFF, an ESRI ASCII grid or another format of GDAL; a relief "
      "of CityGML or CityJSON goes among the inputs");
}

bool is_north_up(const GeoTransform& t) { return t[1] > 0.0 && t[2] == 0.0 && t[4] == 0.0 && t[5] < 0.0; }

/// The raster in another CRS. Pixels are computed when they are read.
GDALDatasetUniquePtr warped(GDALDataset& dataset, const Crs& from, const Crs& to, const std::filesystem::path& file) {
  GDALDatasetUniquePtr result = warped_raster(dataset, {from.wkt(), to.wkt()});
  if (!result) refuse_raster(file, "cannot be brought into " + to.name());
  return result;
}

/// Half-open ranges of columns and rows.
struct TerrainWindow {
  int column = 0, row = 0, column_end = 0, row_end = 0;
};

/// The pixels, of `count`, whose centres lie between `low` and `high`, and one more at each end. Both are counted in pixels from
/// the edge of the first pixel.
std::pair<int, int> pixels_around(double low, double high, int count) {
  const double begin = std::clamp(std::floor(low - 0.5) - 1.0, 0.0, static_cast<double>(count));
  const double end = std::clamp(std::ceil(high - 0.5) + 2.0, 0.0, static_cast<double>(count));
  return {static_cast<int>(begin), static_cast<int>(end)};
}

TerrainWindow window_of(GDALDataset& dataset, const GeoTransform& t, const std::optional<Box2d>& wanted) {
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  if (!wanted) return {0, 0, columns, rows};
  const auto [column, column_end] = pixels_around((wanted->low.x - t[0]) / t[1], (wanted->high.x - t[0]) / t[1], columns);
  const auto [row, row_end] = pixels_around((wanted->high.y - t[3]) / t[5], (wanted->low.y - t[3]) / t[5], rows);
  return {column, row, column_end, row_end};
}

/// Converts the numbers of a band to heights in metres.
struct HeightScale {
  double scale = 1.0, offset = 0.0;

  [[nodiscard]] float metres(double value) const { return static_cast<float>(scale * value + offset); }
};

HeightScale height_scale(GDALRasterBand& band, const Crs& crs) {
  const double unit_m = named_unit_m(band).value_or(crs.height_unit_m());
  return {unit_m * band.GetScale(), unit_m * band.GetOffset()};
}

/// Appends a row of pixels; masked pixels are empty. Returns false when the file is cut short.
[[nodiscard]] bool append_row(GDALRasterBand& band, const TerrainWindow& w, int row, const HeightScale& scale,
                              TerrainRaster& terrain) {
  std::vector<double> values(static_cast<std::size_t>(w.column_end - w.column));
  if (!read_pixels(band, w.column, row, values)) return false;
  for (const double value : values)
    terrain.height_m.push_back(std::isfinite(value) ? std::optional(scale.metres(value)) : std::nullopt);
  return true;
}

/// Empty when the file is cut short.
std::optional<TerrainRaster> read_window(GDALDataset& dataset, const GeoTransform& t, const TerrainWindow& w,
                                         const HeightScale& scale, Point2d origin) {
  TerrainRaster terrain;
  terrain.columns = static_cast<std::size_t>(w.column_end - w.column);
  terrain.rows = static_cast<std::size_t>(w.row_end - w.row);
  terrain.step_m = {t[1], -t[5]};
  // The first row of a file is in the north, that of a terrain in the south
  terrain.first = Point2d{t[0] + (w.column + 0.5) * t[1], t[3] + (w.row_end - 0.5) * t[5]} - origin;
  terrain.height_m.reserve(terrain.columns * terrain.rows);
  for (int row = w.row_end - 1; row >= w.row; --row)
    if (!append_row(*dataset.GetRasterBand(1), w, row, scale, terrain)) return std::nullopt;
  return terrain;
}

/// A raster in the output CRS, north up, and the scale of its heights.
struct ReadyRaster {
  GDALDatasetUniquePtr file;    ///< the source of a resampled raster
  GDALDatasetUniquePtr warped;  ///< empty when the file is used as it is
  HeightScale scale;

  [[nodiscard]] GDALDataset& dataset() const { return warped ? *warped : *file; }
};

ReadyRaster make_ready(const TerrainFile& file, const std::string& fallback_crs, const Crs& output) {
  ReadyRaster ready{open_raster(file), nullptr, {}};
  const std::string own_wkt = wkt_of(ready.file->GetSpatialRef());
  const bool unnamed = own_wkt.empty() && fallback_crs.empty();
  const Crs crs = unnamed ? output : crs_of_input(file.path.string(), own_wkt, fallback_crs).crs;
  ready.scale = height_scale(*ready.file->GetRasterBand(1), crs);
  if (!crs.equals(output) || !is_north_up(geo_transform_of(*ready.file, file.path)))
    ready.warped = warped(*ready.file, crs, output, file.path);
  return ready;
}

}  // namespace

TerrainExtent read_terrain_extent(const TerrainFile& file) {
  const GdalErrors quiet;
  const GDALDatasetUniquePtr dataset = open_raster(file);
  const GeoTransform t = geo_transform_of(*dataset, file.path);
  TerrainExtent extent{wkt_of(dataset->GetSpatialRef()), {}};
  for (const double column : {0.0, static_cast<double>(dataset->GetRasterXSize())})
    for (const double row : {0.0, static_cast<double>(dataset->GetRasterYSize())})
      extent.box.add({t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5]});
  return extent;
}

Georeference georeference_of_terrain(const TerrainFile& file, const GeoreferenceSettings& settings) {
  const TerrainExtent extent = read_terrain_extent(file);
  const Crs input = crs_of_input(file.path.string(), extent.crs_wkt, settings.crs).crs;
  const Point2d centre = 0.5 * (extent.box.low + extent.box.high);
  const Crs output = choose_output_crs(input, centre, settings.out_crs);
  const auto place = input.equals(output) ? centre : CrsTransformation(input, output, centre).apply(centre);
  if (!place) throw InputError(file.path.string() + ": its centre has no place in " + output.name() + ": check its CRS");
  return georeference_around(*place, output);
}

TerrainRaster read_terrain(const TerrainFile& file, const std::string& fallback_crs, const Georeference& georeference,
                           std::optional<Box2d> wanted_city) {
  const GdalErrors quiet;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const ReadyRaster ready = make_ready(file, fallback_crs, *output);
  const GeoTransform t = geo_transform_of(ready.dataset(), file.path);
  if (wanted_city) *wanted_city = {wanted_city->low + georeference.origin_m, wanted_city->high + georeference.origin_m};
  const TerrainWindow window = window_of(ready.dataset(), t, wanted_city);
  if (window.column >= window.column_end || window.row >= window.row_end)
    throw InputError(
        file.path.string() +
        ": does not cover the city: check its CRS, which was taken to be that of --crs or the output if it says none");
  auto terrain = read_window(ready.dataset(), t, window, ready.scale, georeference.origin_m);
  if (!terrain) refuse_raster(file.path, "cannot be read to its end");
  return std::move(*terrain);
}

}  // namespace farlod::georeference
