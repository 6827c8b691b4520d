// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal_priv.h>

#include <array>
#include <mutex>

#include "gdal/gdal_errors.hpp"
#include "ingest/files/map_kind.hpp"

namespace farlod::ingest {
namespace {

bool is_known(const InputFile& file, unsigned int kind) {
  return GDALIdentifyDriverEx(file.path.c_str(), kind, nullptr, nullptr) != nullptr;
}

bool lies_on_the_map(const InputFile& file) {
  const GDALDatasetUniquePtr raster(GDALDataset::Open(file.path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  std::array<double, 6> transform{};
  return raster && raster->GetRasterCount() > 0 && raster->GetGeoTransform(transform.data()) == CE_None;
}

}  // namespace

MapKind map_kind_of(const InputFile& file) {
  static std::once_flag once;
  std::call_once(once, GDALAllRegister);
  const GdalErrors quiet;
  if (is_known(file, GDAL_OF_VECTOR)) return MapKind::features;
  return is_known(file, GDAL_OF_RASTER) && lies_on_the_map(file) ? MapKind::raster : MapKind::unknown;
}

}  // namespace farlod::ingest
