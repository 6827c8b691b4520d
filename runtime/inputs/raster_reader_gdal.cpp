// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/raster_reader_gdal.hpp"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/unread_file.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "inputs/reproject_gdal.hpp"
#include "inputs/requested_points.hpp"

namespace farlod {
namespace {

/// The part of a pixel that files are off which were written with few digits.
constexpr double tolerance = 0.01;

GDALDatasetUniquePtr open_raster(const std::filesystem::path& file, const GdalErrors& errors) {
  if (!std::filesystem::exists(file)) throw PointsError(why_unread(file));
  GDALDatasetUniquePtr dataset = open_within(GdalReach::local_files, file, GDAL_OF_RASTER);
  if (dataset == nullptr)
    throw PointsError(std::filesystem::is_directory(file)
                          ? why_unread(file)
                          : file.string() + " cannot be read as a raster" + (errors.any() ? " (" + errors.last() + ")" : "") +
                                ": give a GeoTIFF or another raster of GDAL's.");
  return dataset;
}

RasterPlan plan_of(GDALDataset& dataset, const std::string& file) {
  // x = x0 + column · dx + row · shear, y = y0 + column · shear + row · dy (GDALDataset::GetGeoTransform)
  std::array<double, 6> g{};
  if (dataset.GetGeoTransform(g.data()) != CE_None)
    throw PointsError(file + " does not say where it lies: give it a geotransform, for instance by gdal_translate -a_ullr");
  const auto columns = static_cast<std::size_t>(dataset.GetRasterXSize()),
             rows = static_cast<std::size_t>(dataset.GetRasterYSize());
  const double widest = static_cast<double>(std::max(columns, rows)), step_m = g[1];
  const auto is_off = [&](double difference) { return !(std::abs(difference) * widest < tolerance * std::abs(step_m)); };
  if (!(step_m > 0.0) || is_off(g[2]) || is_off(g[4]) || is_off(g[5] + step_m))
    throw PointsError(file + " has pixels that are no squares, or do not lie north up: make them so with gdalwarp -tr STEP STEP");
  return {{g[0], g[3]}, step_m, columns, rows};
}

void require_same_crs(const RasterPlan& plan, const std::string& wkt, const std::string& package_crs_wkt,
                      const std::string& file) {
  const double width_m = static_cast<double>(plan.columns) * plan.step_m, height_m = static_cast<double>(plan.rows) * plan.step_m;
  const Point2d corner = plan.north_west_m;
  const std::vector<Point2d> corners{
      corner, {corner.x + width_m, corner.y}, {corner.x, corner.y - height_m}, {corner.x + width_m, corner.y - height_m}};
  const std::vector<Point2d> moved = reprojected(corners, wkt, package_crs_wkt);
  for (std::size_t n = 0; n < corners.size(); ++n)
    if (!(std::hypot(moved[n].x - corners[n].x, moved[n].y - corners[n].y) < tolerance * plan.step_m))
      throw PointsError(file +
                        " is in another CRS than the package: warp it (gdalwarp -t_srs), or pack the city in its CRS "
                        "(farlod-pack --out-crs)");
}

std::string name_of(GDALRasterBand& band) {
  const std::string description = band.GetDescription();
  return description.empty() ? "band " + std::to_string(band.GetBand()) : description;
}

/// The number of the band, from 1.
int band_of(GDALDataset& dataset, const std::string& wanted, const std::filesystem::path& file) {
  std::string names;
  for (int n = 1; n <= dataset.GetRasterCount(); ++n) {
    const std::string name = name_of(*dataset.GetRasterBand(n));
    if (name == (wanted.empty() ? "svf" : wanted)) return n;
    names += (n > 1 ? ", " : "") + name;
  }
  if (!wanted.empty()) throw InputError(file.string() + " has no band " + wanted + ": it has " + names);
  return 1;
}

bool is_in_crs(const OGRSpatialReference& reference, const std::string& crs) {
  OGRSpatialReference other;
  const char* const how[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                             nullptr};
  return other.importFromWkt(crs.c_str()) == OGRERR_NONE && reference.IsSame(&other, how) != 0;
}

/// A file, and in another CRS than its own one that computes pixels from it.
struct OpenRaster {
  GDALDatasetUniquePtr file, warped;

  [[nodiscard]] GDALDataset& dataset() const { return warped ? *warped : *file; }
};

OpenRaster open_in_crs(const std::filesystem::path& file, const std::string& crs) {
  OpenRaster raster{.file = open_height_raster(GdalReach::local_files, file, "is no raster"), .warped = nullptr};
  const OGRSpatialReference* const own = raster.file->GetSpatialRef();
  if (own == nullptr || own->IsLocal() != 0 || crs.empty() || is_in_crs(*own, crs)) return raster;
  raster.warped = warped_raster(*raster.file, {.from_wkt = wkt_of(own), .to_wkt = crs, .resampling = "near"});
  if (!raster.warped) refuse_raster(file, "cannot be brought into the CRS of the package");
  return raster;
}

std::uint32_t thinned(int pixels, double by) { return std::max(1U, static_cast<std::uint32_t>(std::lround(pixels / by))); }

/// The values, thinned by GDAL where there are more pixels than asked for.
void read_values(GDALRasterBand& band, RasterBand& read, const std::filesystem::path& file) {
  const int width = static_cast<int>(read.width), height = static_cast<int>(read.height);
  GDALRasterIOExtraArg how;
  INIT_RASTERIO_EXTRA_ARG(how);
  how.eResampleAlg = GRIORA_Average;
  read.values.resize(std::size_t{read.width} * read.height);
  if (band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), read.values.data(), width, height, GDT_Float32, 0, 0,
                    &how) != CE_None)
    refuse_raster(file, "cannot be read to its end");
  int has_nodata = 0;
  const auto nodata = static_cast<float>(band.GetNoDataValue(&has_nodata));
  for (float& value : read.values)
    if (!std::isfinite(value) || (has_nodata != 0 && value == nodata)) value = std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

RasterGrid read_raster_grid_gdal(const std::filesystem::path& file, const std::string& package_crs_wkt) {
  const GdalErrors errors;
  const GDALDatasetUniquePtr dataset = open_raster(file, errors);
  const RasterGrid grid{plan_of(*dataset, file.string()), dataset->GetSpatialRef() != nullptr};
  if (grid.says_crs) require_same_crs(grid.plan, wkt_of(dataset->GetSpatialRef()), package_crs_wkt, file.string());
  return grid;
}

bool is_raster_file(const std::filesystem::path& file) {
  const GdalErrors quiet;
  return is_known_within(GdalReach::local_files, file, GDAL_OF_RASTER);
}

RasterBand read_raster_gdal(const std::filesystem::path& file, const RasterReading& reading) {
  const GdalErrors quiet;
  const OpenRaster raster = open_in_crs(file, reading.package_crs);
  GDALDataset& dataset = raster.dataset();
  // A warped raster has no names of its bands
  GDALRasterBand& named = *raster.file->GetRasterBand(band_of(*raster.file, reading.band, file));
  GDALRasterBand& band = *dataset.GetRasterBand(named.GetBand());
  const int columns = band.GetXSize(), rows = band.GetYSize();
  const double by = std::max(1.0, std::max(columns, rows) / static_cast<double>(reading.longest_side));
  RasterBand read{.name = name_of(named),
                  .width = thinned(columns, by),
                  .height = thinned(rows, by),
                  .pixels_of_file = static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows),
                  .projected_from_pixel = geo_transform_of(dataset, file)};
  for (const std::size_t n : {1, 4}) read.projected_from_pixel[n] *= static_cast<double>(columns) / read.width;
  for (const std::size_t n : {2, 5}) read.projected_from_pixel[n] *= static_cast<double>(rows) / read.height;
  read_values(band, read, file);
  return read;
}

}  // namespace farlod
