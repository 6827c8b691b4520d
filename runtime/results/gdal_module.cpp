// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/export.hpp"
#include "farlod/version.hpp"
#include "results/gdal_files.hpp"
#include "results/module.hpp"
#include "results/raster/raster_writer_cf.hpp"
#include "results/raster/raster_writer_gdal.hpp"
#include "results/raster/raster_writer_zarr_gdal.hpp"
#include "results/raster/raster_writer_zip_gdal.hpp"
#include "results/table/feature_writer_cf.hpp"
#include "results/table/feature_writer_gdal.hpp"
#include "results/table/feature_writer_geojson.hpp"

namespace farlod {
namespace {

template <class Writer>
std::unique_ptr<RasterWriter> raster_writer(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<Writer>(frame, path);
}

template <class Writer>
std::unique_ptr<FeatureWriter> feature_writer(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<Writer>(frame, path);
}

template <GdalFeatureWriter::Format format>
std::unique_ptr<FeatureWriter> gdal_feature_writer(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GdalFeatureWriter>(format, frame, path);
}

constexpr GdalFiles functions{.geotiff = raster_writer<GeotiffWriter>,
                              .netcdf = raster_writer<CfRasterWriter>,
                              .zarr = raster_writer<ZarrWriter>,
                              .zipped_geotiffs = raster_writer<ZippedGeotiffWriter>,
                              .geopackage = gdal_feature_writer<GdalFeatureWriter::Format::geopackage>,
                              .flatgeobuf = gdal_feature_writer<GdalFeatureWriter::Format::flatgeobuf>,
                              .netcdf_points = feature_writer<CfPointWriter>,
                              .geojson = feature_writer<GeojsonWriter>,
                              .esri_wkt_of = esri_wkt_of,
                              .is_raster_file = is_raster_file,
                              .is_vector_file = is_vector_file,
                              .read_lines = read_lines_gdal,
                              .read_points = read_points_gdal,
                              .read_raster = read_raster_gdal,
                              .read_raster_grid = read_raster_grid_gdal,
                              .read_region = read_region_gdal,
                              .read_table = read_table_gdal,
                              .reprojected = reprojected};

}  // namespace
}  // namespace farlod

extern "C" FARLOD_EXPORT const farlod::ModuleEntry farlod_module{farlod::software_version, &farlod::functions};
