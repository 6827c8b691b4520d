// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/file_format.hpp"

#include <array>
#include <cstring>
#include <filesystem>
#include <optional>

namespace farlod::ingest {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view blanks = " \t\r\n\v\f";
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF"sv;

std::string_view without_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
}

std::string every_other(std::string_view bytes, std::size_t first) {
  std::string text;
  for (std::size_t k = first; k < bytes.size(); k += 2) text += bytes[k];
  return text;
}

/// The text after the first `mark`; empty when there is no mark.
std::string_view after(std::string_view text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  return at == text.npos ? std::string_view() : text.substr(at + mark.size());
}

/// The text after a document type. It may contain definitions in brackets, each of which has a `>` of its own.
std::string_view after_document_type(std::string_view text) {
  const std::size_t bracket = text.find('['), end = text.find('>');
  return after(bracket < end ? after(text, "]") : text, ">");
}

constexpr std::array obj_keywords{"v"sv,      "vt"sv,  "vn"sv,    "vp"sv,       "f"sv,       "fo"sv,     "g"sv,      "o"sv,
                                  "s"sv,      "l"sv,   "p"sv,     "mg"sv,       "mtllib"sv,  "usemtl"sv, "usemap"sv, "maplib"sv,
                                  "cstype"sv, "deg"sv, "curv"sv,  "curv2"sv,    "surf"sv,    "parm"sv,   "trim"sv,   "hole"sv,
                                  "end"sv,    "lod"sv, "bevel"sv, "c_interp"sv, "d_interp"sv};

/// The start tag of the root of an XML text that begins here: "core:CityModel xmlns=…". Empty when there is none.
std::string_view root_tag(std::string_view xml) {
  while (true) {
    xml = without_blanks(xml);
    if (xml.starts_with("<?"))
      xml = after(xml, "?>");
    else if (xml.starts_with("<!--"))
      xml = after(xml, "-->");
    else if (xml.starts_with("<!"))
      xml = after_document_type(xml);
    else
      return xml.starts_with('<') ? xml.substr(1, xml.find('>') - 1) : std::string_view();
  }
}

std::string_view local_name(std::string_view root_tag) {
  const std::string_view name = root_tag.substr(0, root_tag.find_first_of(" \t\r\n/>"));
  return name.substr(name.find(':') + 1);
}

/// Whether the root element is that of CityGML, or a feature collection (WFS) that declares the namespace of CityGML.
bool is_citygml_root(std::string_view root_tag) {
  const std::string_view name = local_name(root_tag);
  return name == "CityModel" || (name == "FeatureCollection" && root_tag.find("opengis.net/citygml") != root_tag.npos);
}

/// Whether a text consists of statements of an OBJ file. `is_whole`: the last line is not cut off.
bool is_obj_text(std::string_view text, bool is_whole) {
  constexpr int enough_statements = 100;
  int statements = 0;
  for (bool is_continued = false; !text.empty() && statements < enough_statements;) {
    const std::size_t end = text.find('\n');
    if (end == text.npos && !is_whole) break;
    std::string_view line = without_blanks(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    const bool is_statement = !is_continued && !line.empty() && line[0] != '#';
    line = line.substr(0, line.find_last_not_of(blanks) + 1);
    is_continued = line.ends_with('\\');
    if (!is_statement) continue;
    const std::string_view keyword = line.substr(0, line.find_first_of(" \t"));
    if (std::find(obj_keywords.begin(), obj_keywords.end(), keyword) == obj_keywords.end()) return false;
    ++statements;
  }
  return statements > 0;
}

std::optional<std::uintmax_t> size_of(const InputFile& file) {
  std::error_code error;
  if (file.pipe || file.is_packed()) return file.declared_bytes;
  const std::uintmax_t bytes = std::filesystem::file_size(file.path, error);
  return error ? std::nullopt : std::optional(bytes);
}

/// Whether a file is as long as binary STL says that it is: 84 bytes, of which the last four count the triangles, and 50 for
/// each.
bool has_size_of_stl(const FileBeginning& beginning) {
  constexpr std::size_t head_bytes = 84, triangle_bytes = 50;
  std::uint32_t triangles = 0;
  if (beginning.bytes.size() < head_bytes) return false;
  std::memcpy(&triangles, beginning.bytes.data() + head_bytes - sizeof triangles, sizeof triangles);
  return size_of(beginning.file) == head_bytes + std::uintmax_t{triangle_bytes} * triangles;
}

/// A point cloud in PLY has no faces.
bool is_ply_with_faces(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, bytes.find("end_header"));
  return (head.starts_with("ply\n") || head.starts_with("ply\r")) && head.find("\nelement face") != head.npos;
}

constexpr InputFormat formats[] = {
    {.name = "CityGML",
     .versions = "1.0 to 3.0",
     .endings = {{{".gml", true}, {".xml", true, true}, {".citygml"}}},
     .is_this = [](const FileBeginning& b) { return b.text.starts_with('<') && is_citygml_root(root_tag(b.text)); },
     .format = FileFormat::citygml,
     .is_piped = true},
    {.name = "CityJSON",
     .versions = "1.0 to 2.0",
     .endings = {{{".city.json"}, {".cityjson"}, {".json", true, true}, {".jsonl", true}}},
     // A pipe cannot be read before it is read
     .is_this = [](const FileBeginning& b) { return !b.file.pipe && b.text.starts_with('{') && is_cityjson(b.file); },
     .advice = {.scale =
                    "CityJSON multiplies its vertices by \"transform\", which may be missing: add it, for millimetres with a "
                    "\"scale\" of 0.001."},
     .format = FileFormat::cityjson},
    {.name = "OBJ",
     .endings = {{{".obj"}}},
     .is_this = [](const FileBeginning& b) { return is_obj_text(b.text, b.is_whole); },
     .advice = {"OBJ is read in metres: scale it where it is exported.", "Give --up y, or --up z if that is given."},
     .format = FileFormat::obj,
     .is_piped = true,
     .is_mesh = true},
    {.name = "STL",
     .endings = {{{".stl"}}},
     .is_this = [](const FileBeginning& b) { return is_text_stl(b.bytes) || has_size_of_stl(b); },
     .advice = {"STL is read in metres: scale it where it is exported.", "Give --up y, or --up z if that is given."},
     .format = FileFormat::stl,
     .is_mesh = true},
    {.name = "PLY",
     .endings = {{{".ply", false, true}}},
     .is_this = [](const FileBeginning& b) { return is_ply_with_faces(b.bytes); },
     .advice = {"PLY is read in metres: scale it where it is exported.", "Give --up y, or --up z if that is given."},
     .format = FileFormat::ply,
     .is_piped = true,
     .is_mesh = true},
    {.name = "GLB",
     .endings = {{{".glb"}}},
     .is_this = [](const FileBeginning& b) { return b.bytes.starts_with("glTF\2\0\0\0"sv); },
     .advice = {"GLB is read in metres: scale it where it is exported.",
                "Give --up z: glTF says that y points up, and this file seems not to know. With --up z, leave it out."},
     .format = FileFormat::glb,
     .is_piped = true,
     .is_mesh = true},
    {.name = "a table of features",
     .endings = {{{".geojson"},
                  {".geojsonl"},
                  {".geojsons"},
                  {".gpkg"},
                  {".shp"},
                  {".fgb"},
                  {".kml"},
                  {".kmz"},
                  {".tab"},
                  {".mif"},
                  {".sqlite"},
                  {".topojson"}}},
     .format = FileFormat::features},
};

const InputFormat* row_of(FileFormat format) {
  for (const InputFormat& known : formats)
    if (known.format == format) return &known;
  return nullptr;
}

/// A format, and the ending of a name that promises it.
struct NamedFormat {
  const InputFormat* format = nullptr;
  FormatEnding ending;
};

NamedFormat named_format(std::string_view file_name) {
  const std::string name = lower_case(file_name);
  for (const InputFormat& format : formats)
    for (const FormatEnding& ending : format.endings)
      if (!ending.text.empty() && name.ends_with(ending.text)) return {&format, ending};
  return {};
}

}  // namespace

std::span<const InputFormat> input_formats() { return formats; }

std::string plain_beginning(std::string_view bytes) {
  if (bytes.starts_with("\xFE\xFF"sv)) return plain_beginning(every_other(bytes, 3));
  if (bytes.starts_with("\xFF\xFE"sv)) return plain_beginning(every_other(bytes, 2));
  if (bytes.starts_with("<\0"sv)) return every_other(bytes, 0);
  if (bytes.starts_with("\0<"sv)) return every_other(bytes, 1);
  if (bytes.starts_with(utf8_mark)) bytes.remove_prefix(utf8_mark.size());
  return std::string(without_blanks(bytes));
}

std::string_view xml_root(std::string_view text) { return local_name(root_tag(text)); }

bool is_text_stl(std::string_view beginning) {
  return without_blanks(beginning).starts_with("solid") && beginning.find('\0') == beginning.npos &&
         (beginning.find("facet") != beginning.npos || beginning.find("endsolid") != beginning.npos);
}

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\3\4"sv) || bytes.starts_with("PK\5\6"sv); }

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"sv); }

namespace {

/// Whether bytes begin like an archive or a packed file: zip, gzip, 7z, rar, bzip2, xz, zstd or tar.
bool is_archive(std::string_view bytes) {
  constexpr std::size_t tar_mark_at = 257;
  if (bytes.size() > tar_mark_at && bytes.substr(tar_mark_at).starts_with("ustar")) return true;
  for (const std::string_view mark : {"7z\xBC\xAF\x27\x1C"sv, "Rar!\x1A\x07"sv, "BZh"sv,
                                      "\xFD"
                                      "7zXZ"sv,
                                      "\x28\xB5\x2F\xFD"sv})
    if (bytes.starts_with(mark)) return true;
  return is_zip(bytes) || is_gzip(bytes);
}

/// Enough to reach the root of an XML file, which follows comments and licences and has a long list of namespaces.
constexpr std::size_t beginning_bytes = std::size_t{1} << 16;

FileFormat format_by_map_kind(const InputFile& file, const std::optional<std::string>& layer) {
  const MapKind kind = map_kind_of(file, layer);
  if (kind == MapKind::only_by_name) return FileFormat::only_by_name;
  return kind == MapKind::features ? FileFormat::features : kind == MapKind::raster ? FileFormat::raster : FileFormat::unknown;
}

}  // namespace

bool is_map_in_zip(std::string_view file_name) { return ends_with_any(file_name, {".kmz", ".xlsx", ".ods", ".shz"}); }

FormatAdvice advice_of(FileFormat format) {
  const InputFormat* known = row_of(format);
  return known != nullptr ? known->advice : FormatAdvice();
}

std::string_view name_of(FileFormat format) {
  if (const InputFormat* known = row_of(format)) return known->name;
  if (format == FileFormat::raster) return "a raster";
  if (format == FileFormat::palm_driver) return "a static driver of PALM";
  if (format == FileFormat::archive) return "an archive";
  return format == FileFormat::only_by_name ? "of a format that may name other files" : "of no format that is known";
}

FileFormat format_by_content(const InputFile& file, const std::optional<std::string>& layer) {
  std::error_code error;
  if (!file.is_packed() && std::filesystem::is_directory(file.path, error)) return format_by_map_kind(file, layer);
  const std::string bytes = read_beginning(file, beginning_bytes), text = plain_beginning(bytes);
  if (is_archive(bytes) && !is_map_in_zip(file.unpacked_name())) return FileFormat::archive;
  const FileBeginning beginning{file, bytes, text, bytes.size() < beginning_bytes};
  for (const InputFormat& format : formats)
    if (format.is_this != nullptr && format.is_this(beginning)) return format.format;
  // A pipe cannot be read before it is read
  if (!file.pipe && !layer && is_palm_driver(file)) return FileFormat::palm_driver;
  return file.pipe ? FileFormat::unknown : format_by_map_kind(file, layer);
}

FileFormat format_by_name(const InputFile& file) {
  const NamedFormat named = named_format(file.unpacked_name());
  return named.format != nullptr ? named.format->format : FileFormat::features;
}

bool name_allows(std::string_view file_name, FileFormat format) {
  const auto [named, ending] = named_format(file_name);
  return named == nullptr || named->format == format || (ending.is_shared && format == FileFormat::features);
}

bool has_city_ending(std::string_view file_name) {
  const auto [named, ending] = named_format(file_name);
  return named != nullptr && !ending.is_ignored;
}

}  // namespace farlod::ingest
