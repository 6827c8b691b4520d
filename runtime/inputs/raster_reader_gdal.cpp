// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/raster_reader_gdal.hpp"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"

namespace farlod {
namespace {

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
