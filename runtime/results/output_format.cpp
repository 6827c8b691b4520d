// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/output_format.hpp"

#include <algorithm>

#include "contract/lower_case.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/raster/raster_writer_esri_ascii.hpp"
#include "results/table/sky_features.hpp"
#include "results/table/sky_table_csv.hpp"
#include "results/table/sky_table_ply.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/raster/esri_wkt_gdal.hpp"
#include "results/raster/raster_writer_gdal.hpp"
#include "results/raster/raster_writer_netcdf.hpp"
#include "results/table/feature_writer_gdal.hpp"
#include "results/table/feature_writer_geojson.hpp"
#endif

namespace farlod {
namespace {

template <class Writer>
std::unique_ptr<RasterWriter> make(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<Writer>(frame, path);
}

/// GIS programs read a `.prj` file only in Esri's WKT 1. Without GDAL it stays as the package has it.
std::string prj_wkt_of(const std::string& wkt) {
#ifdef FARLOD_WITH_GDAL
  return esri_wkt_of(wkt);
#else
  return wkt;
#endif
}

/// For a format that writes a `.prj` file.
template <class Writer>
std::unique_ptr<RasterWriter> make_with_prj(const RasterFrame& frame, const std::filesystem::path& path) {
  RasterFrame frame_of_prj = frame;
  frame_of_prj.crs_wkt = prj_wkt_of(frame.crs_wkt);
  return std::make_unique<Writer>(frame_of_prj, path);
}

void write_points_csv_of(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  write_points_csv(rows, frame.columns, path);
}

std::unique_ptr<SurfaceTablesWriter> make_surface_tables_csv(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesCsv>(frame.columns, path);
}

void write_points_ply_of(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  write_points_ply(rows, frame, path);
}

std::unique_ptr<SurfaceTablesWriter> make_surface_tables_ply(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesBesideCsv>(
      frame, path, [frame, path](SurfaceSpool& receivers) { write_receivers_ply(receivers, frame, path); });
}

#ifdef FARLOD_WITH_GDAL
std::unique_ptr<FeatureWriter> geopackage(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GdalFeatureWriter>(GdalFeatureWriter::Format::geopackage, frame, path);
}
std::unique_ptr<FeatureWriter> flatgeobuf(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GdalFeatureWriter>(GdalFeatureWriter::Format::flatgeobuf, frame, path);
}
std::unique_ptr<FeatureWriter> geojson(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GeojsonWriter>(frame, path);
}

template <auto make_writer>
void write_points_by(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  const std::unique_ptr<FeatureWriter> writer = make_writer(frame, path);
  write_points_as_features(rows, frame, *writer);
  writer->commit();
}

/// For a format that has several layers in a file.
template <auto make_writer>
std::unique_ptr<SurfaceTablesWriter> make_layers(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesInLayers>(frame, path, make_writer(frame, path));
}

/// For a format of one layer a file.
template <auto make_writer>
std::unique_ptr<SurfaceTablesWriter> make_layer_beside_csv(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesBesideCsv>(frame, path, [frame, path](SurfaceSpool& receivers) {
    const std::unique_ptr<FeatureWriter> writer = make_writer(frame, path);
    write_receivers_as_features(receivers, frame, *writer);
    writer->commit();
  });
}
#endif

// name, endings, kind, holds bounds; for rasters and pictures: writer, its memory; for tables: points, surfaces
constexpr OutputFormat formats[] = {
#ifdef FARLOD_WITH_GDAL
    {"GeoTIFF", {".tif", ".tiff"}, OutputKind::raster, true, make<GeotiffWriter>, GeotiffWriter::bytes_for, nullptr, nullptr},
    {"netCDF", {".nc", ""}, OutputKind::raster, true, make<NetcdfWriter>, NetcdfWriter::bytes_for, nullptr, nullptr},
#endif
    {"CSV", {".csv", ""}, OutputKind::table, true, nullptr, nullptr, write_points_csv_of, make_surface_tables_csv},
#ifdef FARLOD_WITH_GDAL
    {"GeoPackage",
     {".gpkg", ""},
     OutputKind::table,
     true,
     nullptr,
     nullptr,
     write_points_by<geopackage>,
     make_layers<geopackage>},
    {"GeoJSON",
     {".geojson", ""},
     OutputKind::table,
     true,
     nullptr,
     nullptr,
     write_points_by<geojson>,
     make_layer_beside_csv<geojson>},
    {"FlatGeobuf",
     {".fgb", ""},
     OutputKind::table,
     true,
     nullptr,
     nullptr,
     write_points_by<flatgeobuf>,
     make_layer_beside_csv<flatgeobuf>},
#endif
    {"PLY", {".ply", ""}, OutputKind::table, true, nullptr, nullptr, write_points_ply_of, make_surface_tables_ply},
    {"PNG", {".png", ""}, OutputKind::picture, false, make<PreviewWriter>, PreviewWriter::bytes_for, nullptr, nullptr},
    {"SVG", {".svg", ""}, OutputKind::picture, false, make<PreviewWriter>, PreviewWriter::bytes_for, nullptr, nullptr},
    {"PDF", {".pdf", ""}, OutputKind::picture, false, make<PreviewWriter>, PreviewWriter::bytes_for, nullptr, nullptr},
    {"ESRI ASCII grid",
     {".asc", ""},
     OutputKind::raster,
     false,
     make_with_prj<EsriAsciiWriter>,
     EsriAsciiWriter::bytes_for,
     nullptr,
     nullptr},
};

constexpr bool is_ending(std::string_view text) {
  return text.size() > 1 && text[0] == '.' && std::none_of(text.begin(), text.end(), [](char c) { return 'A' <= c && c <= 'Z'; });
}

/// A row that lacks what its kind needs, or has what its kind cannot use, does not compile.
constexpr bool is_complete(const OutputFormat& f) {
  const bool is_table = f.kind == OutputKind::table;
  return !f.name.empty() && is_ending(f.endings[0]) && (f.endings[1].empty() || is_ending(f.endings[1])) &&
         (f.raster_writer == nullptr) == is_table && (f.raster_writer_bytes == nullptr) == is_table &&
         (f.write_points != nullptr) == is_table && (f.surface_tables_writer != nullptr) == is_table;
}
#ifndef __SANITIZE_ADDRESS__  // with UndefinedBehaviorSanitizer, which comes with it, g++ takes no function's address for a
                              // constant
static_assert(std::all_of(std::begin(formats), std::end(formats), is_complete));
#endif

/// Number of endings of all formats that are `ending`.
constexpr auto count_of(std::string_view ending) {
  std::ptrdiff_t count = 0;
  for (const OutputFormat& f : formats) count += std::count(f.endings.begin(), f.endings.end(), ending);
  return count;
}
static_assert(std::all_of(std::begin(formats), std::end(formats), [](const OutputFormat& f) {
  return count_of(f.endings[0]) == 1 && (f.endings[1].empty() || count_of(f.endings[1]) == 1);
}));

}  // namespace

std::span<const OutputFormat> output_formats() { return formats; }

const OutputFormat* output_format_of(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending.empty()) return nullptr;
  for (const OutputFormat& format : formats)
    if (ending == format.endings[0] || ending == format.endings[1]) return &format;
  return nullptr;
}

}  // namespace farlod
