// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/export.hpp"
#include "farlod/version.hpp"
#include "results/gdal_files.hpp"
#include "results/module.hpp"
#include "results/raster/raster_writers.hpp"

namespace farlod {
namespace {

constexpr GdalFiles functions{.geotiff = geotiff_writer,
                              .netcdf = netcdf_writer,
                              .zarr = zarr_writer,
                              .zipped_geotiffs = zipped_geotiff_writer,
                              .geopackage = geopackage_writer,
                              .flatgeobuf = flatgeobuf_writer,
                              .netcdf_points = netcdf_point_writer,
                              .geojson = geojson_writer,
                              .esri_wkt_of = esri_wkt_of,
                              .is_raster_file = is_raster_file,
                              .is_vector_file = is_vector_file,
                              .read_lines = read_lines_gdal,
                              .read_points = read_points_gdal,
                              .read_raster = read_raster_gdal,
                              .read_raster_grid = read_raster_grid_gdal,
                              .read_region = read_region_gdal,
                              .read_table = read_table_gdal,
                              .read_zones = read_zones_gdal,
                              .reprojected = reprojected,
                              .reprojected_each = reprojected_each,
                              .reprojected_of_file = reprojected_of_file};

}  // namespace
}  // namespace farlod

extern "C" FARLOD_EXPORT const farlod::ModuleEntry farlod_module{farlod::software_version, &farlod::functions};
