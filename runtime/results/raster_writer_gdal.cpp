// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster_writer_gdal.hpp"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <limits>

#include "farlod/expects.hpp"
#include "farlod/version.hpp"
#include "results/atomic_file.hpp"
#include "results/gdal_errors.hpp"
#include "results/output_error.hpp"

namespace farlod {
namespace {

GDALDatasetUniquePtr create_tiff(const SkyRaster& raster, const AtomicFile& file, const GdalErrors& errors) {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) throw OutputError(file.destination(), "this GDAL cannot write GeoTIFF");
  // Predictor 3 is the one for floats: it halves what DEFLATE alone leaves
  CPLStringList options;
  for (const char* option : {"TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=3", "BIGTIFF=IF_SAFER"}) options.AddString(option);
  constexpr auto largest = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (raster.columns > largest || raster.rows > largest)
    throw OutputError(file.destination(), "the raster has too many pixels along an edge");
  GDALDatasetUniquePtr dataset(driver->Create(file.temporary().c_str(), static_cast<int>(raster.columns),
                                              static_cast<int>(raster.rows), raster.low.empty() ? 1 : 3, GDT_Float32,
                                              options.List()));
  if (dataset == nullptr) throw OutputError(file.destination(), errors.last());
  return dataset;
}

void place(GDALDataset& dataset, const SkyRaster& raster) {
  std::array<double, 6> geotransform{raster.north_west_m.x, raster.step_m, 0.0, raster.north_west_m.y, 0.0, -raster.step_m};
  dataset.SetGeoTransform(geotransform.data());
  if (raster.crs_wkt.empty()) return;
  OGRSpatialReference crs;
  if (crs.importFromWkt(raster.crs_wkt.c_str()) == OGRERR_NONE)
    dataset.SetSpatialRef(&crs);
  else
    CPLError(CE_Failure, CPLE_AppDefined, "the coordinate reference system is not valid WKT");
}

void fill(GDALRasterBand& band, const std::string& name, const std::vector<float>& values) {
  band.SetDescription(name.c_str());
  band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  // RasterIO promises not to change what it writes, but its parameter does not say so
  auto* pixels = const_cast<float*>(values.data());
  const int columns = band.GetXSize(), rows = band.GetYSize();
  const CPLErr refused = band.RasterIO(GF_Write, 0, 0, columns, rows, pixels, columns, rows, GDT_Float32, 0, 0, nullptr);
  if (refused != CE_None && CPLGetLastErrorType() < CE_Failure) CPLError(CE_Failure, CPLE_FileIO, "the pixels were refused");
}

}  // namespace

void write_geotiff(const SkyRaster& raster, const std::filesystem::path& path) {
  FARLOD_EXPECTS(raster.svf.size() == raster.columns * raster.rows);
  const GdalErrors errors;
  AtomicFile file(path);
  GDALDatasetUniquePtr dataset = create_tiff(raster, file, errors);
  place(*dataset, raster);
  dataset->SetMetadataItem("TIFFTAG_SOFTWARE", (std::string("Far-LoD ") + software_version).c_str());
  fill(*dataset->GetRasterBand(1), raster.quantity, raster.svf);
  if (!raster.low.empty()) {
    fill(*dataset->GetRasterBand(2), raster.quantity + "_low", raster.low);
    fill(*dataset->GetRasterBand(3), raster.quantity + "_high", raster.high);
  }
  // A full disk may show only when the last tiles are flushed
  dataset.reset();
  if (errors.any()) throw OutputError(path, errors.last());
  file.commit();
}

}  // namespace farlod
