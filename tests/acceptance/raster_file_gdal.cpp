// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/acceptance/raster_file.hpp"

namespace farlod::acceptance {

Point2d RasterFile::centre_of(std::size_t n) const {
  const auto column = static_cast<double>(n % columns), row = static_cast<double>(n / columns);
  return {north_west.x + (column + 0.5) * step_m, north_west.y - (row + 0.5) * step_m};
}

std::optional<double> RasterFile::at(Point2d p) const {
  const double column = std::floor((p.x - north_west.x) / step_m), row = std::floor((north_west.y - p.y) / step_m);
  if (column < 0.0 || row < 0.0 || column >= static_cast<double>(columns) || row >= static_cast<double>(rows))
    throw std::runtime_error("the raster does not reach the place");
  return values[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
}

RasterFile read_raster(const std::filesystem::path& file, int band_number) {
  GDALAllRegister();
  const std::string name = file.extension() == ".zip"       ? "/vsizip/" + file.string() + "/svf.tif"
                           : file.extension() == ".solweig" ? "/vsizip/" + file.string() + "/svfs.zip/svf.tif"
                           : file.extension() == ".zarr"    ? "ZARR:\"" + file.string() + "\":/svf"
                                                            : file.string();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  std::array<double, 6> place{};
  if (!dataset || dataset->GetGeoTransform(place.data()) != CE_None)
    throw std::runtime_error(file.string() + " is not a raster with a place");
  RasterFile raster{static_cast<std::size_t>(dataset->GetRasterXSize()),
                    static_cast<std::size_t>(dataset->GetRasterYSize()),
                    place[1],
                    {place[0], place[3]},
                    std::nullopt,
                    {}};
  if (const OGRSpatialReference* crs = dataset->GetSpatialRef()) {
    OGRSpatialReference copy(*crs);
    copy.AutoIdentifyEPSG();
    if (const char* code = copy.GetAuthorityCode(nullptr)) raster.epsg = std::stoi(code);
  }
  GDALRasterBand& band = *dataset->GetRasterBand(band_number);
  const int columns = dataset->GetRasterXSize(), rows = dataset->GetRasterYSize();
  std::vector<double> values(raster.columns * raster.rows);
  if (band.RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows, GDT_Float64, 0, 0) != CE_None)
    throw std::runtime_error(file.string() + " cannot be read");
  const double nodata = band.GetNoDataValue();
  for (const double v : values) raster.values.push_back(std::isnan(v) || v == nodata ? std::nullopt : std::optional(v));
  return raster;
}

std::vector<std::string> band_names(const std::filesystem::path& file) {
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (!dataset) throw std::runtime_error(file.string() + " is not a raster");
  std::vector<std::string> names;
  for (int n = 1; n <= dataset->GetRasterCount(); ++n) names.emplace_back(dataset->GetRasterBand(n)->GetDescription());
  return names;
}

BytesArray read_array(const std::filesystem::path& npz_file, const std::string& name) {
  const std::string member = "/vsizip/{" + npz_file.string() + "}/" + name + ".npy";
  VSILFILE* const file = VSIFOpenL(member.c_str(), "rb");
  if (file == nullptr) throw std::runtime_error(npz_file.string() + " has no " + name);
  std::string bytes;
  std::vector<char> piece(1 << 20);
  while (const std::size_t count = VSIFReadL(piece.data(), 1, piece.size(), file)) bytes.append(piece.data(), count);
  VSIFCloseL(file);
  const std::size_t header = bytes.find('\n') + 1, shape = bytes.find("'shape': (");
  BytesArray array;
  if (bytes.find("'descr': '|u1', 'fortran_order': False") > header ||
      std::sscanf(bytes.c_str() + shape, "'shape': (%zu, %zu, %zu)", &array.rows, &array.columns, &array.depth) != 3)
    throw std::runtime_error(name + " is no array of bytes");
  array.bytes = bytes.substr(header);
  if (array.bytes.size() != array.rows * array.columns * array.depth) throw std::runtime_error(name + " is not whole");
  return array;
}

}  // namespace farlod::acceptance
