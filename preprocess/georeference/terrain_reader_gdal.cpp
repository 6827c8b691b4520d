// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_error.h>
#include <gdal.h>
#include <gdal_priv.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "contract/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "georeference/crs.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/output_crs.hpp"
#include "georeference/terrain_reader.hpp"

namespace farlod::georeference {
namespace {

struct DatasetDeleter {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, DatasetDeleter>;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  const std::string reason = CPLGetLastErrorMsg();
  throw InputError(file.string() + ": " + what + (reason.empty() ? "" : " (" + reason + ")"));
}

Dataset open_raster(const TerrainFile& file) {
  CPLErrorReset();
  Dataset dataset(open_within(file.is_named ? GdalReach::local_files : GdalReach::own_data, file.path, GDAL_OF_RASTER).release());
  if (!dataset || dataset->GetRasterCount() < 1)
    fail(file.path,
         "is not a raster of heights that can be read: give a GeoTIFF, an ESRI ASCII grid or another format of GDAL; a relief "
         "of CityGML or CityJSON goes among the inputs");
  return dataset;
}

/// East of pixel (column, row) = [0] + column·[1] + row·[2], north = [3] + column·[4] + row·[5].
using GeoTransform = std::array<double, 6>;

GeoTransform geo_transform(GDALDataset& dataset, const std::filesystem::path& file) {
  GeoTransform t{};
  if (dataset.GetGeoTransform(t.data()) != CE_None)
    fail(file, "has no place on the map: give it one with gdal_translate -a_ullr, or a world file");
  return t;
}

bool is_north_up(const GeoTransform& t) { return t[1] > 0.0 && t[2] == 0.0 && t[4] == 0.0 && t[5] < 0.0; }

/// The unit of the band in metres, if it names a known one.
std::optional<double> named_unit_m(GDALRasterBand& band) {
  const std::string unit = band.GetUnitType();
  constexpr double us_survey_foot_m = 1200.0 / 3937.0, foot_m = 0.3048;
  for (const char* name : {"ftUS", "us-ft", "US survey foot", "US survey feet", "Foot_US", "us_survey_feet"})
    if (EQUAL(unit.c_str(), name)) return us_survey_foot_m;
  for (const char* name : {"ft", "foot", "feet", "international foot"})
    if (EQUAL(unit.c_str(), name)) return foot_m;
  for (const char* name : {"m", "metre", "metres", "meter", "meters"})
    if (EQUAL(unit.c_str(), name)) return 1.0;
  return std::nullopt;
}

/// The raster in another CRS. Pixels are computed when they are read.
Dataset warped(GDALDataset& dataset, const Crs& from, const Crs& to, const std::filesystem::path& file) {
  const std::string from_wkt = from.wkt(), to_wkt = to.wkt();
  // A scale of 1 keeps GDAL from widening the kernel where pixels get larger, which would change slopes
  const std::vector<std::string> words{"-of",        "VRT", "-s_srs", from_wkt,   "-t_srs",  to_wkt,    "-r",
                                       "bilinear",   "-et", "0",      "-ot",      "Float64", "-wt",     "Float64",
                                       "-dstnodata", "nan", "-wo",    "XSCALE=1", "-wo",     "YSCALE=1"};
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const std::unique_ptr<GDALWarpAppOptions, void (*)(GDALWarpAppOptions*)> options(
      GDALWarpAppOptionsNew(arguments.data(), nullptr), GDALWarpAppOptionsFree);
  GDALDatasetH source = GDALDataset::ToHandle(&dataset);
  Dataset result(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options.get(), nullptr)));
  if (!result) fail(file, "cannot be brought into " + to.name());
  return result;
}

/// Half-open ranges of columns and rows.
struct Window {
  int column = 0, row = 0, column_end = 0, row_end = 0;
};

/// Of `count` pixels, those whose centres lie between `low` and `high`, and one more at each end. Both are counted in pixels from
/// the edge of the first pixel.
std::pair<int, int> pixels_around(double low, double high, int count) {
  const double begin = std::clamp(std::floor(low - 0.5) - 1.0, 0.0, static_cast<double>(count));
  const double end = std::clamp(std::ceil(high - 0.5) + 2.0, 0.0, static_cast<double>(count));
  return {static_cast<int>(begin), static_cast<int>(end)};
}

Window window_of(GDALDataset& dataset, const GeoTransform& t, const std::optional<Box2d>& wanted) {
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
[[nodiscard]] bool append_row(GDALRasterBand& band, const Window& w, int row, const HeightScale& scale, TerrainRaster& terrain) {
  const int count = w.column_end - w.column;
  std::vector<double> values(static_cast<std::size_t>(count));
  std::vector<unsigned char> mask(values.size());
  if (band.RasterIO(GF_Read, w.column, row, count, 1, values.data(), count, 1, GDT_Float64, 0, 0, nullptr) != CE_None ||
      band.GetMaskBand()->RasterIO(GF_Read, w.column, row, count, 1, mask.data(), count, 1, GDT_Byte, 0, 0, nullptr) != CE_None)
    return false;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool has_data = mask[k] != 0 && std::isfinite(values[k]);
    terrain.height_m.push_back(has_data ? std::optional(scale.metres(values[k])) : std::nullopt);
  }
  return true;
}

/// Empty when the file is cut short.
std::optional<TerrainRaster> read_window(GDALDataset& dataset, const GeoTransform& t, const Window& w, const HeightScale& scale,
                                         Point2d origin) {
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
  Dataset file;    ///< the source of a resampled raster
  Dataset warped;  ///< empty when the file is used as it is
  HeightScale scale;

  [[nodiscard]] GDALDataset& dataset() const { return warped ? *warped : *file; }
};

ReadyRaster make_ready(const TerrainFile& file, const std::string& fallback_crs, const Crs& output) {
  ReadyRaster ready{open_raster(file), nullptr, {}};
  const std::string own_wkt = wkt_of(ready.file->GetSpatialRef());
  const bool unnamed = own_wkt.empty() && fallback_crs.empty();
  const Crs crs = unnamed ? output : crs_of_input(file.path.string(), own_wkt, fallback_crs).crs;
  ready.scale = height_scale(*ready.file->GetRasterBand(1), crs);
  if (!crs.equals(output) || !is_north_up(geo_transform(*ready.file, file.path)))
    ready.warped = warped(*ready.file, crs, output, file.path);
  return ready;
}

}  // namespace

TerrainExtent read_terrain_extent(const TerrainFile& file) {
  const GdalErrors quiet;
  const Dataset dataset = open_raster(file);
  const GeoTransform t = geo_transform(*dataset, file.path);
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
  const GeoTransform t = geo_transform(ready.dataset(), file.path);
  if (wanted_city) *wanted_city = {wanted_city->low + georeference.origin_m, wanted_city->high + georeference.origin_m};
  const Window window = window_of(ready.dataset(), t, wanted_city);
  if (window.column >= window.column_end || window.row >= window.row_end)
    throw InputError(
        file.path.string() +
        ": does not cover the city: check its CRS, which was taken to be that of --crs or the output if it says none");
  auto terrain = read_window(ready.dataset(), t, window, ready.scale, georeference.origin_m);
  if (!terrain) fail(file.path, "cannot be read to its end");
  return std::move(*terrain);
}

}  // namespace farlod::georeference
