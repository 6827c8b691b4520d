// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal_priv.h>

#include <array>

#include "gdal/gdal_errors.hpp"
#include "gdal/local_data_gdal.hpp"
#include "ingest/files/map_kind.hpp"

namespace farlod::ingest {
namespace {

GdalReach reach_of(const InputFile& file) { return file.is_named ? GdalReach::local_files : GdalReach::own_data; }

bool lies_on_the_map(const InputFile& file) {
  const GDALDatasetUniquePtr raster = open_within(reach_of(file), file.path, GDAL_OF_RASTER);
  std::array<double, 6> transform{};
  return raster && raster->GetRasterCount() > 0 && raster->GetGeoTransform(transform.data()) == CE_None;
}

}  // namespace

MapKind map_kind_of(const InputFile& file) {
  const GdalErrors quiet;
  const GdalReach reach = reach_of(file);
  if (is_known_within(reach, file.path, GDAL_OF_VECTOR)) return MapKind::features;
  if (is_known_within(reach, file.path, GDAL_OF_RASTER)) return lies_on_the_map(file) ? MapKind::raster : MapKind::unknown;
  const bool is_for_a_name =
      !file.is_named && is_known_within(GdalReach::local_files, file.path, GDAL_OF_RASTER | GDAL_OF_VECTOR);
  return is_for_a_name ? MapKind::only_by_name : MapKind::unknown;
}

}  // namespace farlod::ingest
