// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/file_format.hpp"

#include <filesystem>
#include <optional>

#include "ingest/files/file_beginning.hpp"
#include "ingest/files/file_ending.hpp"
#include "ingest/files/json_kind.hpp"
#include "ingest/files/map_kind.hpp"

namespace farlod::ingest {
namespace {

/// Enough to reach the root of an XML file, which follows comments and licences and has a long list of namespaces.
constexpr std::size_t beginning_bytes = std::size_t{1} << 16;

FileFormat format_by_map_kind(const InputFile& file) {
  const MapKind kind = map_kind_of(file);
  if (kind == MapKind::only_by_name) return FileFormat::only_by_name;
  return kind == MapKind::features ? FileFormat::features : kind == MapKind::raster ? FileFormat::raster : FileFormat::unknown;
}

}  // namespace

bool is_map_in_zip(std::string_view file_name) { return ends_with_any(file_name, {".kmz", ".xlsx", ".ods", ".shz"}); }

std::string_view name_of(FileFormat format) {
  switch (format) {
    case FileFormat::citygml:
      return "CityGML";
    case FileFormat::cityjson:
      return "CityJSON";
    case FileFormat::obj:
      return "OBJ";
    case FileFormat::features:
      return "a table of features";
    case FileFormat::raster:
      return "a raster";
    case FileFormat::archive:
      return "an archive";
    case FileFormat::only_by_name:
      return "of a format that may name other files";
    case FileFormat::unknown:
      break;
  }
  return "of no format that is known";
}

FileFormat format_by_content(const InputFile& file) {
  std::error_code error;
  if (!file.is_packed() && std::filesystem::is_directory(file.path, error)) return format_by_map_kind(file);
  const std::string bytes = read_beginning(file, beginning_bytes), text = plain_beginning(bytes);
  if (is_archive(bytes) && !is_map_in_zip(file.unpacked_name())) return FileFormat::archive;
  if (text.starts_with('<') && is_citygml_root(root_tag(text))) return FileFormat::citygml;
  // A pipe cannot be read before it is read
  if (!file.pipe && text.starts_with('{') && is_cityjson(file)) return FileFormat::cityjson;
  if (is_obj_text(text, bytes.size() < beginning_bytes)) return FileFormat::obj;
  return file.pipe ? FileFormat::unknown : format_by_map_kind(file);
}

FileFormat format_by_name(const InputFile& file) {
  const std::string name = file.unpacked_name();
  if (ends_with_any(name, {".gml", ".xml", ".citygml"})) return FileFormat::citygml;
  if (ends_with_any(name, {".json", ".cityjson", ".jsonl"})) return FileFormat::cityjson;
  if (ends_with_any(name, {".obj"})) return FileFormat::obj;
  return FileFormat::features;
}

bool name_allows(std::string_view file_name, FileFormat format) {
  const bool is_features = format == FileFormat::features;
  if (ends_with_any(file_name, {".citygml"})) return format == FileFormat::citygml;
  if (ends_with_any(file_name, {".gml", ".xml"})) return format == FileFormat::citygml || is_features;
  if (ends_with_any(file_name, {".city.json", ".cityjson"})) return format == FileFormat::cityjson;
  if (ends_with_any(file_name, {".json", ".jsonl"})) return format == FileFormat::cityjson || is_features;
  if (ends_with_any(file_name, {".obj"})) return format == FileFormat::obj;
  if (ends_with_any(file_name, {".geojson", ".geojsonl", ".gpkg", ".shp", ".fgb", ".kml", ".kmz"})) return is_features;
  return true;
}

}  // namespace farlod::ingest
