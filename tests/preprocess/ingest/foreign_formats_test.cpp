// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/files/foreign_format.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "archive_writer.hpp"
#include "farlod/error.hpp"
#include "ingest/files/input_search.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using namespace std::string_literals;
using testing::AllOf;
using testing::HasSubstr;

struct Foreign {
  std::string file, beginning, said;
};

const std::string xml = "<?xml version=\"1.0\"?>\n";
const std::string points = "690000.5 5335000 500.1\n690001.5 5335000 500.2\n690002.5 5335003 500.3\n690004.5 5335000 500.4\n";
const std::string dxf = "  0\nSECTION\n  2\nENTITIES\n  0\nENDSEC\n  0\nEOF\n";
const std::string sketchup = "\xFF\xFE\xFF\x0ES\0k\0e\0t\0c\0h\0U\0p\0"s;

std::string refusal(const Foreign& foreign) {
  const auto file = write_file(foreign.file, foreign.beginning);
  return scenes::refusal_of<InputError>([&] { (void)read_file(file); });
}

TEST(ForeignFormats, AreRefusedWithWhatConvertsThem) {
  for (const Foreign& foreign :
       {Foreign{"a.dxf", "0\nSECTION\n2\nENTITIES\n",
                "a CAD drawing (DXF, DWG, DGN), which is not read: export the bodies as OBJ"},
        Foreign{"a.dwg", "AC1032\1\2", "a CAD drawing"},
        Foreign{"a.ifc", "ISO-10303-21;\nHEADER;", "IfcConvert FILE.ifc"},
        Foreign{"a.stp", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AP214'));", "a STEP model"},
        Foreign{"a.ifcxml", xml + "<ifc:ifcXML xmlns:ifc=\"x\">", "an IFC model"},
        Foreign{"tileset.json", R"({"asset":{"version":"1.0"},"geometricError":500,"root":{}})", "3D Tiles"},
        Foreign{"a.gltf", R"({"asset":{},"meshes":[],"accessors":[]})", "a mesh of another format than those that are read"},
        Foreign{"long.gltf", R"({"accessors":[)", "a mesh of another format"},
        Foreign{"old.glb", "glTF\1\0\0\0"s, "a mesh of another format"},
        Foreign{"a.fbx", "Kaydara FBX Binary", "assimp export"},
        Foreign{"text.fbx", "; FBX 7.3.0 project file\n", "assimp export"},
        Foreign{"a.x3d", xml + "<X3D version=\"3.0\"><Scene/></X3D>", "assimp export"},
        Foreign{"a.wrl", "#VRML V2.0 utf8\n", "assimp export"},
        Foreign{"a.blend", "BLENDER-v293", "assimp export"},
        Foreign{"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nend_header\n", "a point cloud"},
        Foreign{"a.las", "LASF\1", "PDAL"},
        Foreign{"scan", "ASTM-E57\1", "a point cloud"},
        Foreign{"a.xml", xml + R"(<gbXML xmlns="http://www.gbxml.org/schema">)", "gbXML"},
        Foreign{"a.inx", "<ENVI-MET_Datei>\n<Header>", "ENVI-met"},
        Foreign{"a.gml", R"(<gml:FeatureCollection xmlns:bu="http://inspire.ec.europa.eu/schemas/bu-core2d/4.0">)", "INSPIRE"},
        Foreign{"b.gml", R"(<base:SpatialDataSet xmlns:bu="http://inspire.ec.europa.eu/schemas/bu-core3d/4.0">)", "INSPIRE"},
        Foreign{"a.parquet", "PAR1\1", "GeoPackage"},
        Foreign{"plan.pdf", "%PDF-1.7", "a document"},
        Foreign{"project", sketchup, "a file of SketchUp"},
        Foreign{"a.qgs", "<!DOCTYPE qgis PUBLIC 'x' 'y'>\n<qgis/>", "QGIS"},
        Foreign{"town.mtl", "newmtl red\n", "give the .obj"}}) {
    EXPECT_THAT(refusal(foreign), AllOf(HasSubstr(foreign.file), HasSubstr(foreign.said), HasSubstr("which is not read")));
  }
}

TEST(ForeignFormats, AreKnownByTheirContentWhateverTheirName) {
  for (const Foreign& foreign :
       {Foreign{"drawing.gml", dxf, "a CAD drawing"}, Foreign{"drawing", dxf, "a CAD drawing"},
        Foreign{"marked.ifc", "\xEF\xBB\xBFISO-10303-21;\nHEADER;", "an IFC model"},
        Foreign{"noted.ifc", "/* by hand */\nISO-10303-21;\nFILE_SCHEMA(('IFC4'));", "an IFC model"},
        Foreign{"a.dae", "\xFF\xFE<\0C\0O\0L\0L\0A\0D\0A\0>\0"s, "assimp export"}, Foreign{"scan.txt", points, "a point cloud"},
        Foreign{"scan.pts", "4\n" + points, "a point cloud"},
        Foreign{"scan.csv", "1,2,3\n2,2,5\n5,4,1\n5,9,9\n", "a point cloud"},
        Foreign{"photo.gml", "P5\n4 4\n255\n" + std::string(16, '\1'), "without a place on the map"},
        Foreign{"names.txt", "Notes\non the city\n", "a plain text"}})
    EXPECT_THAT(refusal(foreign), AllOf(HasSubstr(foreign.said), HasSubstr("which is not read"))) << foreign.file;
}

/// What a download gives in place of a file.
TEST(ForeignFormats, AnswersOfServersAreNamed) {
  const std::string page = "<!DOCTYPE html>\n<html lang=\"en\"><head><title>Log in</title></head></html>";
  for (const char* name :
       {"city.gml", "city.geojson", "city.city.json", "city.obj", "city.stl", "city.glb", "city.gpkg", "city.tif"})
    EXPECT_THAT(refusal({name, page, ""}), HasSubstr("is a web page, which is not read: a browser shows")) << name;
  EXPECT_THAT(refusal({"city.gml", "<HTML>\n<HEAD>", ""}), HasSubstr("a web page"));
  for (const Foreign& foreign :
       {Foreign{"a.gml", xml + "<ows:ExceptionReport xmlns:ows=\"x\"/>", "a message of a service about an error"},
        Foreign{"a.geojson", R"({"error":{"code":499,"message":"Token Required"}})", "a message of a service about an error"},
        Foreign{"a.json", R"({"version":0.6,"generator":"Overpass API","elements":[]})", "osmtogeojson"},
        Foreign{"a.json", R"({"version":0.6,"osm3s":{"timestamp_osm_base":"2026"},"elements":[]})", "[out:xml]"},
        Foreign{"b.gml", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n", "git lfs pull"}})
    EXPECT_THAT(refusal(foreign), HasSubstr(foreign.said));
  const std::string nothing = R"({"type":"FeatureCollection","features":[]})";
  EXPECT_THAT(refusal({"a.geojson", nothing, ""}), HasSubstr("holds no feature: its layer a is empty"));
}

TEST(ForeignFormats, AMapOfModelsHasNoAreas) {
  const std::string model =
      "<Model><Location><longitude>11.5</longitude><latitude>48.1</latitude></Location>"
      "<Link><href>a.dae</href></Link></Model>";
  const std::string kml = xml + "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document><Placemark><name>a</name>" + model +
                          "</Placemark></Document></kml>";
  EXPECT_THAT(refusal({"a.kml", kml, ""}), HasSubstr("holds no areas, which footprints are"));
}

/// Alone in a folder or an archive, they are named as well.
TEST(ForeignFormats, AreNamedInFoldersAndArchives) {
  const scenes::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "tiles");
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder.path() / name, std::ios::binary) << bytes;
    return folder.path() / name;
  };
  const auto refusal_of_search = [](const std::filesystem::path& input) {
    Report report;
    return scenes::refusal_of<InputError>([&] { (void)find_input_files(std::vector{input}, report); });
  };
  write("tiles/0.b3dm", "b3dm\1");
  write("tiles/tileset.json", R"({"asset":{},"root":{},"geometricError":1})");
  const std::string ifc = "ISO-10303-21;\nHEADER;";
  EXPECT_THAT(refusal_of_search(folder.path() / "tiles"),
              AllOf(HasSubstr("holds no file of a city: "), HasSubstr("0.b3dm is a tile or tileset of 3D Tiles or I3S")));
  EXPECT_THAT(refusal_of_search(write("a.zip", zip_of({{"model/a.ifc", ifc}}))),
              AllOf(HasSubstr("a.zip holds no file of a city: "), HasSubstr("model/a.ifc is an IFC model")));
  EXPECT_THAT(refusal_of_search(write("b.zip", zip_of({{"a.xml", xml + "<gbXML/>"}}))), HasSubstr("gbXML"));
  for (const auto& [name, said] : {std::pair("a.ifczip", "an IFC model"), std::pair("a.3mf", "a mesh of another format"),
                                   std::pair("a.skp", "SketchUp"), std::pair("a.slpk", "I3S"), std::pair("a.qgz", "QGIS")})
    EXPECT_THAT(refusal_of_search(write(name, zip_of({{"inside.bin", "x"}}))),
                AllOf(HasSubstr(std::string(name) + " is a"), HasSubstr(said)));
}

/// A table is read by its column of WKT, also under the names that others than GDAL give it.
TEST(Tables, HaveTheirOutlinesInAColumnOfText) {
  for (const std::string column : {"WKT", "wkt", "geometry", "geom", "the_geom"}) {
    const auto file = write_file("houses.csv", "id,height," + column +
                                                   "\na,12,\"POLYGON((690000 5335000,690010 5335000,690010 5335010,"
                                                   "690000 5335010,690000 5335000))\"\n");
    EXPECT_EQ(read_file(file).city().buildings().size(), 1U) << column;
  }
}

}  // namespace
}  // namespace farlod::ingest::test
