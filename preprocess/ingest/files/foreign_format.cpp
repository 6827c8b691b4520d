// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/foreign_format.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string>

#include "ingest/files/file_format.hpp"

namespace farlod::ingest {
namespace {

using namespace std::string_view_literals;

/// How a file of a format is known: by its first bytes, by the root of its XML in lower case, by words that its beginning has
/// all of, or by the ending of its name.
struct KnownBy {
  std::string_view magic = {};
  std::string_view root = {};
  std::array<std::string_view, 3> words = {};
  std::string_view ending = {};
};

struct Row {
  KnownBy by;
  ForeignFormat format;
};

constexpr ForeignFormat drawing{"a CAD drawing (DXF, DWG, DGN)",
                                "export the bodies as OBJ, or closed outlines as a Shapefile or GeoPackage"};
constexpr ForeignFormat building_model{"an IFC model", "`IfcConvert FILE.ifc FILE.obj` of IfcOpenShell makes an OBJ"};
constexpr ForeignFormat step{"a STEP model", "FreeCAD exports it as OBJ"};
constexpr ForeignFormat tiles{"a tile or tileset of 3D Tiles or I3S",
                              "take the data that the tiles were made of, or make OBJ of its files (Blender), and give its CRS"};
constexpr ForeignFormat mesh{"a mesh of another format than those that are read",
                             "`assimp export FILE FILE.obj` or Blender makes an OBJ"};
constexpr ForeignFormat project{"a file of SketchUp, Revit, 3ds Max or Rhino", "export the bodies as OBJ"};
constexpr ForeignFormat point_cloud{
    "a point cloud", "make a raster of its highest points, by PDAL's writers.gdal with output_type max, and give that"};
constexpr ForeignFormat parquet{
    "a table in (Geo)Parquet, for which this GDAL has no driver",
    "`geopandas.read_parquet(FILE).to_file(\"FILE.gpkg\")` in Python, DuckDB, or an ogr2ogr that has one, "
    "makes a GeoPackage"};
constexpr ForeignFormat plain_text{"a plain text", "give the file of the city that it belongs to; call a table .csv"};
constexpr ForeignFormat inspire{"GML of INSPIRE's buildings",
                                "ask the publisher for CityGML or footprints, or convert it with hale studio"};
constexpr ForeignFormat energy_model{"a model for simulations (gbXML, IDF, ENVI-met)", "export its bodies as OBJ"};
constexpr ForeignFormat document{"a document", "give the data that it shows"};
constexpr ForeignFormat web_page{"a web page", "a browser shows whether it asks to log in, or why there is no file"};
constexpr ForeignFormat service_error{"a message of a service about an error", "its text says why there is no city"};
constexpr ForeignFormat overpass{"JSON of OpenStreetMap's Overpass", "ask it for [out:xml], or make GeoJSON with osmtogeojson"};
constexpr ForeignFormat git_pointer{"a pointer of Git LFS to a file that is not here", "`git lfs pull` fetches it"};
constexpr ForeignFormat materials{"a list of the materials of an OBJ", "give the .obj"};
constexpr ForeignFormat map_project{"a project of QGIS", "give the layers that it shows"};
constexpr ForeignFormat placeless{"a picture, or a raster without a place on the map",
                                  "give it one by gdal_translate -a_ullr and -a_srs, or a world file"};

/// The first row that fits counts.
constexpr std::array rows{
    Row{{.magic = "AC10"}, drawing},
    Row{{.magic = "AutoCAD Binary DXF"}, drawing},
    Row{{.magic = "0\nSECTION"}, drawing},
    Row{{.magic = "0\r\nSECTION"}, drawing},
    Row{{.words = {"SECTION", "$ACADVER"}}, drawing},
    Row{{.magic = "\x08\x09\xFE"}, drawing},
    Row{{.ending = ".dxf"}, drawing},
    Row{{.words = {"ISO-10303-21", "FILE_SCHEMA", "IFC"}}, building_model},
    Row{{.magic = "ISO-10303-21", .ending = ".ifc"}, building_model},
    Row{{.root = "ifcxml"}, building_model},
    Row{{.ending = ".ifczip"}, building_model},
    Row{{.magic = "ISO-10303-21"}, step},
    Row{{.magic = "b3dm"}, tiles},
    Row{{.magic = "i3dm"}, tiles},
    Row{{.magic = "pnts"}, tiles},
    Row{{.magic = "cmpt"}, tiles},
    Row{{.magic = "subt"}, tiles},
    Row{{.words = {"\"asset\"", "\"root\"", "\"geometricError\""}}, tiles},
    Row{{.ending = ".3tz"}, tiles},
    Row{{.ending = ".slpk"}, tiles},
    Row{{.words = {"\"asset\"", "\"meshes\"", "\"accessors\""}}, mesh},
    Row{{.ending = ".gltf"}, mesh},
    Row{{.magic = "glTF"}, mesh},
    Row{{.root = "collada"}, mesh},
    Row{{.root = "x3d"}, mesh},
    Row{{.magic = "#VRML"}, mesh},
    Row{{.magic = "#usda"}, mesh},
    Row{{.ending = ".usdz"}, mesh},
    Row{{.ending = ".off"}, mesh},
    Row{{.magic = "Kaydara FBX Binary"}, mesh},
    Row{{.magic = "; FBX"}, mesh},
    Row{{.magic = "BLENDER"}, mesh},
    Row{{.ending = ".blend"}, mesh},
    Row{{.ending = ".3ds"}, mesh},
    Row{{.ending = ".3mf"}, mesh},
    Row{{.magic = "3D Geometry File Format"}, project},
    Row{{.magic = "\xFF\xFE\xFF\x0ES\0k\0e\0t\0c\0h\0U\0p"sv}, project},
    Row{{.ending = ".skp"}, project},
    Row{{.ending = ".rvt"}, project},
    Row{{.ending = ".max"}, project},
    Row{{.magic = "LASF"}, point_cloud},
    Row{{.magic = "ply"}, point_cloud},
    Row{{.magic = "ASTM-E57"}, point_cloud},
    Row{{.ending = ".e57"}, point_cloud},
    Row{{.words = {"inspire.ec.europa.eu/schemas/bu"}}, inspire},
    Row{{.words = {"x-inspire:specification:gmlas:Buildings"}}, inspire},
    Row{{.root = "gbxml"}, energy_model},
    Row{{.root = "envi-met_datei"}, energy_model},
    Row{{.ending = ".idf"}, energy_model},
    Row{{.magic = "%PDF"}, document},
    Row{{.ending = ".docx"}, document},
    Row{{.ending = ".pptx"}, document},
    Row{{.root = "html"}, web_page},
    Row{{.root = "svg"}, document},
    Row{{.root = "exceptionreport"}, service_error},
    Row{{.root = "serviceexceptionreport"}, service_error},
    Row{{.magic = "{\"error\""}, service_error},
    Row{{.words = {"\"elements\"", "\"osm3s\""}}, overpass},
    Row{{.words = {"\"elements\"", "\"generator\"", "Overpass"}}, overpass},
    Row{{.magic = "version https://git-lfs"}, git_pointer},
    Row{{.ending = ".mtl"}, materials},
    Row{{.root = "qgis"}, map_project},
    Row{{.ending = ".qgz"}, map_project},
};

/// The beginning of a file: its bytes, the same without marks and blanks before a text, and the root of its XML.
struct Beginning {
  std::string bytes, text, root;
};

bool fits(const KnownBy& by, const Beginning& beginning, std::string_view file_name) {
  const auto has = [&](std::string_view word) { return beginning.text.find(word) != std::string::npos; };
  const bool has_magic = beginning.bytes.starts_with(by.magic) || beginning.text.starts_with(by.magic);
  return has_magic && std::ranges::all_of(by.words, has) && (by.root.empty() || by.root == beginning.root) &&
         (by.ending.empty() || ends_with_any(file_name, {by.ending}));
}

/// Whether a line is three numbers or more.
bool is_point(std::string line) {
  std::ranges::replace_if(
      line, [](char c) { return c == ',' || c == ';'; }, ' ');
  std::istringstream numbers(line);
  double number = 0.0;
  int count = 0;
  while (numbers >> number) ++count;
  return count >= 3 && numbers.eof();
}

/// Whether the first lines of a text are points, but for one with their number.
bool is_list_of_points(const std::string& beginning) {
  constexpr int lines_to_see = 20;
  std::istringstream text(beginning);
  int points = 0, others = 0;
  for (std::string line; points + others < lines_to_see && std::getline(text, line) && !text.eof();)
    ++(is_point(line) ? points : others);
  return points > 2 && others <= 1;
}

bool has_control_characters(const std::string& beginning) {
  return std::ranges::any_of(beginning, [](unsigned char c) { return (c < ' ' && (c < '\t' || c > '\r')) || c == 0x7F; });
}

/// Whether a file is a text for people: called like one, without control characters, and of no other format. A city that is
/// damaged or misnamed is none.
bool is_plain_text(const InputFile& file, const std::string& beginning, const std::string& name) {
  const bool is_called_so =
      ends_with_any(name, {".txt", ".md", ".rst", ".adoc", ".log", ".rtf"}) || !std::filesystem::path(name).has_extension();
  const bool is_marked_up = beginning.starts_with('<') || beginning.starts_with('{') || beginning.starts_with('[');
  return is_called_so && !beginning.empty() && !has_control_characters(beginning) && !is_marked_up &&
         format_by_content(file) == FileFormat::unknown;
}

}  // namespace

const ForeignFormat* foreign_format_of(const InputFile& file) {
  constexpr std::size_t beginning_bytes = std::size_t{1} << 16;
  std::error_code error;
  if (file.pipe || (!file.is_packed() && std::filesystem::is_directory(file.path, error))) return nullptr;
  Beginning beginning{read_beginning(file, beginning_bytes), {}, {}};
  beginning.text = plain_beginning(beginning.bytes);
  beginning.root = lower_case(xml_root(beginning.text));
  const std::string name = file.unpacked_name();
  for (const Row& row : rows)
    if (fits(row.by, beginning, name)) return &row.format;
  const MapKind kind = map_kind_of(file);
  if (beginning.bytes.starts_with("PAR1") && kind == MapKind::unknown) return &parquet;
  // GDAL takes texts with numbers for rasters
  if (kind != MapKind::raster && is_list_of_points(beginning.text)) return &point_cloud;
  if (kind == MapKind::placeless_raster && has_control_characters(beginning.bytes)) return &placeless;
  return is_plain_text(file, beginning.bytes, name) ? &plain_text : nullptr;
}

std::string refusal_of(const InputFile& file, const ForeignFormat& format) {
  return file.name + " is " + std::string(format.name) + ", which is not read: " + std::string(format.advice) + ".";
}

}  // namespace farlod::ingest
