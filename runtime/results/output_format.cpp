// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/output_format.hpp"

#include <algorithm>

#include "base/lower_case.hpp"
#include "results/mesh/mesh_file.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/raster/raster_writer_esri_ascii.hpp"
#include "results/table/sky_features.hpp"
#include "results/table/sky_table_csv.hpp"
#include "results/table/sky_table_ply.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#include "results/raster/raster_writer_solweig.hpp"
#include "results/raster/raster_writers.hpp"
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
  return gdal_files().esri_wkt_of(wkt);
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

void write_forms_csv_of(const FormTable& table, const TableFrame&, const std::filesystem::path& path) {
  write_morphology_csv(table, path);
}

void write_points_ply_of(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  write_points_ply(rows, frame, path);
}

std::unique_ptr<SurfaceTablesWriter> make_surface_tables_ply(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesBesideCsv>(
      frame, path, [frame, path](SurfaceSpool& receivers) { write_receivers_ply(receivers, frame, path); });
}

std::unique_ptr<SurfaceTablesWriter> make_surfaces_glb(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfacesGlb>(frame, path);
}

#ifdef FARLOD_WITH_GDAL
/// GDAL is loaded while the first cells are evaluated.
template <auto make_writer>
std::unique_ptr<RasterWriter> await(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<AwaitedRasterWriter>([frame, path] { return (gdal_files().*make_writer)(frame, path); }, frame.threads);
}

/// A writer of ours that needs GDAL.
template <class Writer>
std::unique_ptr<RasterWriter> await_writer(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<AwaitedRasterWriter>([frame, path] { return std::make_unique<Writer>(frame, path); }, frame.threads);
}

template <auto make_writer>
void write_points_by(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  const std::unique_ptr<FeatureWriter> writer = (gdal_files().*make_writer)(frame, path);
  write_points_as_features(rows, frame, *writer);
  writer->commit();
}

template <auto make_writer>
void write_forms_by(const FormTable& table, const TableFrame& frame, const std::filesystem::path& path) {
  const std::unique_ptr<FeatureWriter> writer = (gdal_files().*make_writer)(frame, path);
  write_morphology_as_features(table, *writer);
  writer->commit();
}

/// For a format that has several layers in a file.
template <auto make_writer>
std::unique_ptr<SurfaceTablesWriter> make_layers(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesInLayers>(frame, path, (gdal_files().*make_writer)(frame, path));
}

template <auto make_writer>
std::unique_ptr<FeatureWriter> make_feature_writer(const TableFrame& frame, const std::filesystem::path& path) {
  return (gdal_files().*make_writer)(frame, path);
}

/// For a format of one layer a file.
template <auto make_writer>
std::unique_ptr<SurfaceTablesWriter> make_files(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesInFiles>(frame, path, &make_feature_writer<make_writer>);
}

/// For a format of one layer of points a file.
template <auto make_writer>
std::unique_ptr<SurfaceTablesWriter> make_layer_beside_csv(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<SurfaceTablesBesideCsv>(frame, path, [frame, path](SurfaceSpool& receivers) {
    const std::unique_ptr<FeatureWriter> writer = (gdal_files().*make_writer)(frame, path);
    write_receivers_as_features(receivers, frame, *writer);
    writer->commit();
  });
}
#endif

// What a file has for a row and for each of its values was measured on 100,000 points and 5 million pixels, two thirds of which
// lay in streets
constexpr OutputFormat formats[] = {
#ifdef FARLOD_WITH_GDAL
    {.name = "GeoTIFF",
     .endings = {".tif", ".tiff"},
     .holds_bounds = true,
     .raster_writer = await<&GdalFiles::geotiff>,
     .raster_writer_bytes = geotiff_bytes,
     .bytes_of_pixel = 2.1},
    {.name = "netCDF",
     .endings = {".nc", ""},
     .holds_bounds = true,
     .raster_writer = await<&GdalFiles::netcdf>,
     .raster_writer_bytes = netcdf_bytes,
     .write_points = write_points_by<&GdalFiles::netcdf_points>,
     .surface_tables_writer = make_layer_beside_csv<&GdalFiles::netcdf_points>,
     .write_forms = write_forms_by<&GdalFiles::netcdf_points>,
     .bytes_of_pixel = 1.5,
     .bytes_of_row = 16.0,
     .bytes_of_value = 4.0},
    {.name = "Zarr",
     .endings = {".zarr", ""},
     .is_folder = true,
     .holds_bounds = true,
     .raster_writer = await<&GdalFiles::zarr>,
     .raster_writer_bytes = zarr_bytes,
     .bytes_of_pixel = 1.5},
    {.name = "GeoTIFFs in a ZIP file",
     .endings = {".zip", ""},
     .holds_bounds = true,
     .is_for_solweig = true,
     .raster_writer = await<&GdalFiles::zipped_geotiffs>,
     .raster_writer_bytes = zipped_geotiff_bytes,
     .bytes_of_pixel = 2.1},
    {.name = "folder for SOLWEIG",
     .endings = {".solweig", ""},
     .is_folder = true,
     .holds_bounds = true,
     .is_for_solweig = true,
     .is_solweig_kit = true,
     .raster_writer = await_writer<SolweigWriter>,
     .raster_writer_bytes = SolweigWriter::bytes_for,
     .bytes_of_pixel = 1.5},
#endif
    {.name = "CSV",
     .endings = {".csv", ""},
     .holds_bounds = true,
     .write_points = write_points_csv_of,
     .surface_tables_writer = make_surface_tables_csv,
     .write_forms = write_forms_csv_of,
     .bytes_of_row = 25.0,
     .bytes_of_value = 7.4},
#ifdef FARLOD_WITH_GDAL
    {.name = "GeoPackage",
     .endings = {".gpkg", ""},
     .holds_bounds = true,
     .write_points = write_points_by<&GdalFiles::geopackage>,
     .surface_tables_writer = make_layers<&GdalFiles::geopackage>,
     .write_forms = write_forms_by<&GdalFiles::geopackage>,
     .bytes_of_row = 73.0,
     .bytes_of_value = 7.3},
    {.name = "GeoJSON",
     .endings = {".geojson", ""},
     .holds_bounds = true,
     .write_points = write_points_by<&GdalFiles::geojson>,
     .surface_tables_writer = make_files<&GdalFiles::geojson>,
     .write_forms = write_forms_by<&GdalFiles::geojson>,
     .bytes_of_row = 140.0,
     .bytes_of_value = 30.0},
    {.name = "FlatGeobuf",
     .endings = {".fgb", ""},
     .holds_bounds = true,
     .write_points = write_points_by<&GdalFiles::flatgeobuf>,
     .surface_tables_writer = make_files<&GdalFiles::flatgeobuf>,
     .write_forms = write_forms_by<&GdalFiles::flatgeobuf>,
     .bytes_of_row = 175.0,
     .bytes_of_value = 7.9},
#endif
    {.name = "PLY",
     .endings = {".ply", ""},
     .holds_bounds = true,
     .write_points = write_points_ply_of,
     .surface_tables_writer = make_surface_tables_ply,
     .bytes_of_row = 39.0,
     .bytes_of_value = 4.0},
    {.name = "GLB",
     .endings = {".glb", ""},
     .write_points = write_points_glb,
     .surface_tables_writer = make_surfaces_glb,
     .bytes_of_row = 16.0},
    {.name = "PNG",
     .endings = {".png", ""},
     .is_picture = true,
     .raster_writer = make<PreviewWriter>,
     .raster_writer_bytes = PreviewWriter::bytes_for,
     .bytes_of_pixel = 0.4},
    {.name = "SVG",
     .endings = {".svg", ""},
     .is_picture = true,
     .raster_writer = make<PreviewWriter>,
     .raster_writer_bytes = PreviewWriter::bytes_for,
     .bytes_of_pixel = 1.3},
    {.name = "PDF",
     .endings = {".pdf", ""},
     .is_picture = true,
     .raster_writer = make<PreviewWriter>,
     .raster_writer_bytes = PreviewWriter::bytes_for,
     .bytes_of_pixel = 0.4},
    {.name = "ESRI ASCII grid",
     .endings = {".asc", ""},
     .raster_writer = make_with_prj<EsriAsciiWriter>,
     .raster_writer_bytes = EsriAsciiWriter::bytes_for,
     .bytes_of_pixel = 9.0},
};

constexpr bool is_ending(std::string_view text) {
  return text.size() > 1 && text[0] == '.' && std::none_of(text.begin(), text.end(), [](char c) { return 'A' <= c && c <= 'Z'; });
}

/// A row that lacks what goes with something else of it does not compile.
constexpr bool is_complete(const OutputFormat& f) {
  const bool has_pixels = f.raster_writer != nullptr;
  return !f.name.empty() && is_ending(f.endings[0]) && (f.endings[1].empty() || is_ending(f.endings[1])) &&
         (has_pixels || f.holds_tables()) && (has_pixels || !f.is_picture) && (f.raster_writer_bytes != nullptr) == has_pixels &&
         (f.surface_tables_writer != nullptr) == f.holds_tables() && (f.bytes_of_pixel > 0.0) == has_pixels &&
         (f.bytes_of_row > 0.0) == f.holds_tables();
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

struct CityEnding {
  std::string_view ending;
  CityFileFormat format;
};

constexpr std::array<CityEnding, 6> city_endings{{{".city.json", CityFileFormat::cityjson},
                                                  {".city.jsonl", CityFileFormat::cityjsonseq},
                                                  {".jsonl", CityFileFormat::cityjsonseq},
                                                  {".gml", CityFileFormat::citygml},
                                                  {".xml", CityFileFormat::citygml},
                                                  {".citygml", CityFileFormat::citygml}}};

}  // namespace

std::span<const OutputFormat> output_formats() { return formats; }

const OutputFormat* output_format_of(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending.empty()) return nullptr;
  for (const OutputFormat& format : formats)
    if (ending == format.endings[0] || ending == format.endings[1]) return &format;
  return nullptr;
}

std::string name_of(CityFileFormat format) {
  if (format == CityFileFormat::cityjsonseq) return "CityJSONSeq";
  return format == CityFileFormat::cityjson ? "CityJSON" : "CityGML";
}

std::optional<CityFileFormat> city_format_of(const std::filesystem::path& path) {
  const std::string name = lower_case(path.filename().string());
  for (const auto& [ending, format] : city_endings)
    if (name.size() > ending.size() && name.ends_with(ending)) return format;
  return std::nullopt;
}

std::string endings_of(CityFileFormat format) {
  std::string list, last;
  for (const auto& [ending, of_format] : city_endings) {
    if (of_format != format) continue;
    if (!last.empty()) list += (list.empty() ? "" : ", ") + last;
    last = ending;
  }
  return list.empty() ? last : list + " or " + last;
}

}  // namespace farlod
