// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/foreign_format.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "ingest/files/file_format.hpp"

namespace farlod::ingest {
namespace {

using namespace std::string_view_literals;

/// How a file of a format is known: by its first bytes, by words that its beginning has all of, or by the ending of its name.
struct KnownBy {
  std::string_view magic = {};
  std::array<std::string_view, 3> words = {};
  std::string_view ending = {};
};

struct Row {
  KnownBy by;
  ForeignFormat format;
};

constexpr ForeignFormat drawing{"a CAD drawing (DXF, DWG)",
                                "export the bodies as OBJ, or closed outlines as a Shapefile or GeoPackage"};
constexpr ForeignFormat building_model{"an IFC model", "`IfcConvert FILE.ifc FILE.obj` of IfcOpenShell makes an OBJ"};
constexpr ForeignFormat tiles{"a tile or tileset of 3D Tiles",
                              "take the data that the tiles were made of, or make OBJ of its files (Blender), and give its CRS"};
constexpr ForeignFormat mesh{"a mesh of another format than those that are read",
                             "`assimp export FILE FILE.obj` or Blender makes an OBJ"};
constexpr ForeignFormat point_cloud{
    "a point cloud", "make a raster of its highest points, by PDAL's writers.gdal with output_type max, and give that"};
constexpr ForeignFormat parquet{
    "a table in (Geo)Parquet, for which this GDAL has no driver",
    "`geopandas.read_parquet(FILE).to_file(\"FILE.gpkg\")` in Python, DuckDB, or an ogr2ogr that has one, "
    "makes a GeoPackage"};
constexpr ForeignFormat plain_text{"a plain text", "give the file of the city that it belongs to"};
constexpr ForeignFormat inspire{"GML of INSPIRE's buildings",
                                "ask the publisher for CityGML or footprints, or convert it with hale studio"};
constexpr ForeignFormat energy_model{"a model of one building for simulations (gbXML, IDF)", "export its bodies as OBJ"};
constexpr ForeignFormat overpass{"JSON as Overpass answers (\"elements\")",
                                 "ask Overpass for [out:xml] and name the answer .osm, or make GeoJSON of it by osmtogeojson"};
constexpr ForeignFormat document{"a document", "give the data that it shows"};

/// The first row that fits counts.
constexpr std::array rows{
    Row{{.magic = "AC10"}, drawing},
    Row{{.magic = "AutoCAD Binary DXF"}, drawing},
    Row{{.ending = ".dxf"}, drawing},
    Row{{.magic = "ISO-10303-21"}, building_model},
    Row{{.magic = "b3dm"}, tiles},
    Row{{.magic = "i3dm"}, tiles},
    Row{{.magic = "pnts"}, tiles},
    Row{{.magic = "cmpt"}, tiles},
    Row{{.words = {"\"asset\"", "\"root\"", "\"geometricError\""}}, tiles},
    Row{{.words = {"\"asset\"", "\"meshes\"", "\"accessors\""}}, mesh},
    Row{{.words = {"<COLLADA"}}, mesh},
    Row{{.magic = "Kaydara FBX Binary"}, mesh},
    Row{{.magic = "3D Geometry File Format"}, mesh},
    Row{{.ending = ".3ds"}, mesh},
    Row{{.ending = ".skp"}, mesh},
    Row{{.magic = "LASF"}, point_cloud},
    Row{{.magic = "ply"}, point_cloud},
    Row{{.ending = ".e57"}, point_cloud},
    Row{{.words = {"inspire.ec.europa.eu/schemas/bu", "FeatureCollection"}}, inspire},
    Row{{.words = {"\"elements\"", "\"osm3s\"", "{"}}, overpass},
    Row{{.words = {"\"elements\"", "\"generator\"", "Overpass"}}, overpass},
    Row{{.words = {"<gbXML"}}, energy_model},
    Row{{.ending = ".idf"}, energy_model},
    Row{{.magic = "%PDF"}, document},
};

bool fits(const KnownBy& by, const std::string& beginning, std::string_view file_name) {
  const bool has_magic = beginning.starts_with(by.magic);
  const bool has_words =
      std::ranges::all_of(by.words, [&](std::string_view word) { return beginning.find(word) != beginning.npos; });
  return has_magic && has_words && (by.ending.empty() || ends_with_any(file_name, {by.ending}));
}

/// Whether a file is a text for people: called like one, without control characters, and of no other format. A city that is
/// damaged or misnamed is none.
bool is_plain_text(const InputFile& file, const std::string& beginning, const std::string& name) {
  const bool is_called_so =
      ends_with_any(name, {".txt", ".md", ".rst", ".adoc", ".log", ".rtf"}) || !std::filesystem::path(name).has_extension();
  const bool has_control =
      std::ranges::any_of(beginning, [](unsigned char c) { return (c < ' ' && (c < '\t' || c > '\r')) || c == 0x7F; });
  const bool is_marked_up = beginning.starts_with('<') || beginning.starts_with('{') || beginning.starts_with('[');
  return is_called_so && !beginning.empty() && !has_control && !is_marked_up && format_by_content(file) == FileFormat::unknown;
}

}  // namespace

const ForeignFormat* foreign_format_of(const InputFile& file) {
  constexpr std::size_t beginning_bytes = std::size_t{1} << 16;
  std::error_code error;
  if (file.pipe || (!file.is_packed() && std::filesystem::is_directory(file.path, error))) return nullptr;
  const std::string beginning = read_beginning(file, beginning_bytes), name = file.unpacked_name();
  for (const Row& row : rows)
    if (fits(row.by, beginning, name)) return &row.format;
  if (beginning.starts_with("PAR1") && map_kind_of(file) == MapKind::unknown) return &parquet;
  if (is_plain_text(file, beginning, name)) return &plain_text;
  return nullptr;
}

}  // namespace farlod::ingest
