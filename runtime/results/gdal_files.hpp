// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "inputs/raster_reader_gdal.hpp"
#include "inputs/reproject_gdal.hpp"
#include "inputs/vector_reader_gdal.hpp"
#include "inputs/zone_reader_gdal.hpp"
#include "results/crs_gdal.hpp"
#include "results/module.hpp"
#include "results/raster/raster_writer.hpp"
#include "results/table/feature_writer.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// All that the programs ask of GDAL and netCDF: the functions of the module `farlod_gdal`.
struct GdalFiles {
  using MakeRasterWriter = std::unique_ptr<RasterWriter> (*)(const RasterFrame& frame, const std::filesystem::path& path);
  using MakeFeatureWriter = std::unique_ptr<FeatureWriter> (*)(const TableFrame& frame, const std::filesystem::path& path);

  MakeRasterWriter geotiff, netcdf, zarr, zipped_geotiffs;
  MakeFeatureWriter geopackage, flatgeobuf, netcdf_points, geojson;

  decltype(&farlod::esri_wkt_of) esri_wkt_of;
  decltype(&farlod::is_raster_file) is_raster_file;
  decltype(&farlod::is_vector_file) is_vector_file;
  decltype(&read_lines_gdal) read_lines;
  decltype(&read_points_gdal) read_points;
  decltype(&read_raster_gdal) read_raster;
  decltype(&read_raster_grid_gdal) read_raster_grid;
  decltype(&read_region_gdal) read_region;
  decltype(&read_table_gdal) read_table;
  decltype(&read_zones_gdal) read_zones;
  decltype(&farlod::reprojected) reprojected;
  decltype(&farlod::reprojected_each) reprojected_each;
  decltype(&farlod::reprojected_of_file) reprojected_of_file;
};

/// Loads the module at the first call. Throws InputError where it is missing.
[[nodiscard]] inline const GdalFiles& gdal_files() {
  static const auto& files = *static_cast<const GdalFiles*>(functions_of_module("farlod_gdal", "GDAL"));
  return files;
}

}  // namespace farlod
