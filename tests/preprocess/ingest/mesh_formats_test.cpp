// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "archive_writer.hpp"
#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/files/input_search.hpp"
#include "ingest/mesh/mesh_classes.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/mesh_files.hpp"
#include "tests/scenes/refusal.hpp"

// Triangles in STL, PLY and GLB, and the table of formats that are read.

namespace farlod::ingest::test {
namespace {

using scenes::TriangleMesh;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two tetrahedra that do not touch; the corners are whole numbers, which float has exactly.
TriangleMesh two_tetrahedra() {
  TriangleMesh mesh;
  for (const double x : {100.0, 200.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Point3d& p : {Point3d{x, 50, 7}, {x + 9, 50, 7}, {x, 60, 7}, {x, 50, 20}}) mesh.vertices.push_back(p);
    for (const auto& [a, b, c] : std::array<std::array<std::uint32_t, 3>, 4>{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}})
      mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

std::vector<Point3d> points_of(const Reading& r) { return {r.city().points().begin(), r.city().points().end()}; }
std::vector<std::string> ids_of(const Reading& r) {
  std::vector<std::string> ids;
  for (const Building& b : r.city().buildings()) ids.push_back(b.id);
  return ids;
}

struct MeshFile {
  const char* name;
  std::string (*bytes)(const TriangleMesh&);
  FileFormat format;
};
void PrintTo(const MeshFile& file, std::ostream* out) { *out << file.name; }

const std::array mesh_files{
    MeshFile{"text.stl", [](const TriangleMesh& m) { return scenes::stl_text_of(m); }, FileFormat::stl},
    MeshFile{"binary.stl", [](const TriangleMesh& m) { return scenes::stl_of(m); }, FileFormat::stl},
    MeshFile{"text.ply", [](const TriangleMesh& m) { return scenes::ply_text_of(m); }, FileFormat::ply},
    MeshFile{"little.ply", [](const TriangleMesh& m) { return scenes::ply_of(m, false); }, FileFormat::ply},
    MeshFile{"big.ply", [](const TriangleMesh& m) { return scenes::ply_of(m, true); }, FileFormat::ply},
    MeshFile{"a.glb", [](const TriangleMesh& m) { return scenes::glb_of(m); }, FileFormat::glb}};

class MeshFormats : public testing::TestWithParam<MeshFile> {};

TEST_P(MeshFormats, GiveWhatObjGives) {
  const TriangleMesh mesh = two_tetrahedra();
  const Reading expected = read_text("a.obj", scenes::obj_of(mesh)), found = read_text(GetParam().name, GetParam().bytes(mesh));
  EXPECT_THAT(ids_of(found), ElementsAre("component 1", "component 2"));
  EXPECT_EQ(ids_of(found), ids_of(expected));
  EXPECT_EQ(points_of(found), points_of(expected));
  EXPECT_TRUE(found.codes().empty());
}

TEST_P(MeshFormats, AreKnownByTheirContent) {
  const std::string bytes = GetParam().bytes(two_tetrahedra());
  const std::filesystem::path file = write_file("without_an_ending", bytes), misnamed = write_file("a.obj", bytes);
  EXPECT_EQ(format_by_content(file), GetParam().format);
  EXPECT_EQ(read_file(misnamed).codes(), std::set<int>{117});
  Report report;
  EXPECT_EQ(find_input_files(std::vector{file.parent_path()}, report).files.size(), 2U);
  EXPECT_EQ(read_text("moved.bin", bytes).source.advice.scale.substr(0, 3), name_of(GetParam().format));
}

TEST_P(MeshFormats, ArePutInPlaceAndUnpacked) {
  const std::string bytes = GetParam().bytes(two_tetrahedra()), name = GetParam().name;
  const std::filesystem::path gzip = write_file(name + ".gz", gzip_of(bytes));
  write_file(name.substr(0, name.find('.')) + ".offset", "500000.25 5400000.5 -3");
  Report report;
  const std::vector<SourceCity> cities = ingest_all(find_input_files(std::vector{gzip}, report).files, {}, report);
  EXPECT_EQ(cities.at(0).city.points()[0], (Point3d{500100.25, 5400050.5, 4.0}));
}

TEST_P(MeshFormats, CutShortAreRefused) {
  const std::string bytes = GetParam().bytes(two_tetrahedra()), name = GetParam().name;
  const std::filesystem::path file = write_file(name, bytes.substr(0, bytes.size() - 30));
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(file); }), HasSubstr(name));
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormats, testing::ValuesIn(mesh_files));

TEST(Stl, SeveralSolidsAreObjects) {
  const TriangleMesh mesh = two_tetrahedra();
  TriangleMesh one = mesh, other = mesh;
  one.triangles.resize(4);
  other.triangles.erase(other.triangles.begin(), other.triangles.begin() + 4);
  const Reading r = read_text("a.stl", scenes::stl_text_of(one, "north wing") + scenes::stl_text_of(other, "south wing") +
                                           scenes::stl_text_of(one, "Terrain"));
  EXPECT_THAT(ids_of(r), ElementsAre("north wing", "south wing"));
  EXPECT_EQ(r.source.relief_points.size(), 12U);
  EXPECT_THAT(r.source.notes, ElementsAre(HasSubstr("ground by their names: 4 of terrain")));
}

TEST(Ply, ListsMayStandAnywhereAndOtherElementsAreLeftOut) {
  const std::string head =
      "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty list char float weights\r\nproperty float x\r\nproperty float "
      "y\r\n"
      "property float z\r\nelement cloud 1\r\nproperty int a\r\nelement face 3\r\nproperty uchar colour\r\n"
      "property list int uint vertex_index\r\nproperty list uchar float texcoord\r\nelement empty 9\r\nend_header\r\n";
  const Reading r =
      read_text("a.ply", head + "2 .5 .5 0 0 0\n0 9 0 0\n0 9 9 0\n0 0 9 x\n7\n1 3 0 1 2 1 .5\n1 3 0 1 4 0\n1 3 0 2 3 0\n");
  EXPECT_EQ(r.city().facets().size(), 1U);
  EXPECT_EQ(r.codes(), (std::set<int>{102, 110}));
  EXPECT_THAT(r.report.problems()[0].detail, HasSubstr("face of face 2 names a vertex"));
}

TEST(Ply, OfUnknownNumbersIsRefused) {
  const auto file = write_file("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nelement face 1\nend_header\n");
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(file); }), HasSubstr("unknown type, \"half\""));
}

TEST(Ply, PointCloudsInFoldersAreNoCities) {
  write_file("scan.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n");
  const std::filesystem::path town = write_file("town.obj", obj_of("a"));
  Report report;
  const FoundInputs found = find_input_files(std::vector{town.parent_path()}, report);
  EXPECT_EQ(found.files.size(), 1U);
  EXPECT_EQ(found.skipped.at(".ply files"), 1U);
}

TEST(Glb, NodesPlaceTheirMeshes) {
  const TriangleMesh mesh = two_tetrahedra();
  // Moved by a hundred thousand, turned by a quarter about the upward axis, and made twice as large
  const std::string below = R"(,"nodes":[{"name":"a","children":[1],"translation":[500000.125,3,-5400000.25]},)"
                            R"({"name":"b","mesh":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476],"scale":[2,2,2]},)"
                            R"({"name":"c","mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,1000,1]}],"scenes":[{"nodes":[0,2]}],)"
                            R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})";
  const Reading r = read_text("a.glb", scenes::glb_of("{" + scenes::glb_lists_of(mesh) + below, scenes::glb_binary_of(mesh)));
  EXPECT_THAT(ids_of(r), ElementsAre("b", "c"));
  const auto turned = r.city().ring(r.city().facets()[0], 0), moved = r.city().ring(r.city().facets()[8], 0);
  // x goes to y, and y to -x
  constexpr double rounding_of_quaternion_m = 1e-9;  // some hundred metres, and an eps of the double
  EXPECT_NEAR(turned[0].x, 500000.125 - 100.0, rounding_of_quaternion_m);
  EXPECT_NEAR(turned[0].y, 5400000.25 + 200.0, 2.0 * rounding_of_quaternion_m);
  EXPECT_NEAR(turned[0].z, 17.0, rounding_of_quaternion_m);
  EXPECT_EQ(moved[0], (Point3d{100, -950, 7}));
}

TEST(Glb, WhatCesiumAddsIsAddedInDouble) {
  const Reading r = read_text(
      "a.glb", scenes::glb_of(two_tetrahedra(), "", R"(,"extensions":{"CESIUM_RTC":{"center":[549947.0625,5499959.892,12.5]}})"));
  EXPECT_EQ(points_of(r)[0], (Point3d{550047.0625, 5499959.892 + 50.0, 19.5}));
}

TEST(Glb, TheUserMayKnowBetterWhatIsUp) {
  IngestSettings settings;
  settings.up = UpAxis::z;
  EXPECT_EQ(points_of(read_text("a.glb", scenes::glb_of(two_tetrahedra()), settings))[0], (Point3d{100, 7, -50}));
}

TEST(Glb, StripsFansAndSmallNumbersAreTriangles) {
  // Five points as normalized 16-bit numbers, of a node that makes them as large as they are; lines are not read
  std::string binary;
  for (const int coordinate : {0, 0, 0, 9, 0, 0, 0, 9, 0, 9, 9, 0, 0, 0, 9})
    scenes::append_bytes(binary, static_cast<std::int16_t>(coordinate));
  for (const int corner : {0, 1, 2, 3, 0, 1, 4, 9}) scenes::append_bytes(binary, static_cast<std::uint8_t>(corner));
  const auto primitive = [](int mode, int accessor) {
    return R"({"attributes":{"POSITION":0},"mode":)" + std::to_string(mode) + R"(,"indices":)" + std::to_string(accessor) + "}";
  };
  const std::string json =
      R"({"buffers":[{"byteLength":38}],"bufferViews":[{"buffer":0},{"buffer":0,"byteOffset":30}],"accessors":[)"
      R"({"bufferView":0,"componentType":5122,"normalized":true,"type":"VEC3","count":5},)"
      R"({"bufferView":1,"componentType":5121,"type":"SCALAR","count":4},)"
      R"({"bufferView":1,"byteOffset":4,"componentType":5121,"type":"SCALAR","count":4}],)"
      R"("meshes":[{"primitives":[)" +
      primitive(5, 1) + "," + primitive(6, 2) + "," + primitive(1, 1) +
      R"(]}],"nodes":[{"mesh":0,"scale":[32767,32767,32767]}]})";
  IngestSettings settings;
  settings.up = UpAxis::z;
  const Reading r = read_text("a.glb", scenes::glb_of(json, binary), settings);
  EXPECT_EQ(r.codes(), (std::set<int>{110, 112})) << "the fan's second triangle names point 9";
  const std::vector<Point3d> points = points_of(r);
  const Point3d a{}, b{9, 0, 0}, c{0, 9, 0}, d{9, 9, 0}, e{0, 0, 9};
  EXPECT_EQ(points, (std::vector<Point3d>{a, b, c, c, b, d, a, b, e}));
}

TEST(Glb, WhatIsNotReadIsSaid) {
  const TriangleMesh mesh = two_tetrahedra();
  const auto refusal = [](const std::string& bytes) {
    return scenes::refusal_of<InputError>([&] { (void)read_file(write_file("a.glb", bytes)); });
  };
  EXPECT_THAT(refusal(scenes::glb_of(mesh, "", R"(,"extensionsRequired":["KHR_draco_mesh_compression"])")),
              AllOf(HasSubstr("KHR_draco_mesh_compression"), HasSubstr("export it without")));
  EXPECT_THAT(refusal(scenes::glb_of(mesh, "", R"(,"extensions":{"CESIUM_RTC":{"center":[4156305,671404,4774508]}})")),
              HasSubstr("geocentric"));
  EXPECT_THAT(refusal(scenes::glb_of(R"({"nodes":[{"mesh":0}]})", "")), HasSubstr("one of its meshes is missing"));
  EXPECT_THAT(refusal(scenes::glb_of("[1", "")), HasSubstr("JSON"));
  // A small file that names a mesh of many points often
  TriangleMesh large = mesh;
  large.vertices.resize(100'000);
  std::string nodes = R"({"mesh":0})";
  for (int n = 0; n < 200; ++n) nodes += R"(,{"mesh":0})";
  EXPECT_THAT(refusal(scenes::glb_of("{" + scenes::glb_lists_of(large) +
                                         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"nodes":[)" +
                                         nodes + "]}",
                                     scenes::glb_binary_of(large))),
              HasSubstr("more often than a city does"));
}

TEST(GroundNames, AreTheUsersBesideThoseThatAreKnown) {
  const std::vector<std::string> names{"Gelände", "site surface"};
  for (const char* name : {"Gelände", "geLände_12", "SITE SURFACE.001", "Terrain"})
    EXPECT_EQ(class_of_name(name, names), MeshClass::ground) << name;
  for (const char* name : {"Geländer", "site", "Gelände Nord", ""})
    EXPECT_EQ(class_of_name(name, names), MeshClass::building) << name;
  EXPECT_EQ(class_of_name("Terrainé"), MeshClass::building) << "another word";
  IngestSettings settings;
  settings.ground_names = {"tree", "lot"};
  const std::string mesh = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 5\ng Lot 7\nf 1 2 3\nf 1 3 2\ng Tree\nf 1 2 3\ng house\nf 1 2 4\n";
  const Reading r = read_text("a.obj", mesh, settings);
  EXPECT_THAT(ids_of(r), ElementsAre("house"));
  EXPECT_EQ(r.source.relief_points.size(), 9U);
  EXPECT_TRUE(r.source.skipped.empty());
  EXPECT_THAT(r.source.notes, ElementsAre(HasSubstr("2 of lot, 1 of tree")));
}

TEST(GroundNames, CornersThatAreNoPointsAreReported) {
  const Reading r = read_text("a.obj", "v 0 0 0\nv 9 0 0\nv 0 x 0\nv 0 9 0\ng Terrain\nf 1 2 3\nf 1 2 4\n");
  EXPECT_EQ(r.source.relief_points.size(), 5U);
  EXPECT_EQ(r.codes(), std::set<int>{102});
}

TEST(InputFormats, AdviceGoesByTheContentOfAFile) {
  for (const char* name : {"a.OBJ", "town", "a.geojson"})
    EXPECT_EQ(read_text(name, obj_of("a")).source.advice.scale, "OBJ is read in metres: scale it where it is exported.") << name;
  EXPECT_THAT(std::string(read_text("a.obj", cityjson_of("a")).source.advice.scale), HasSubstr("transform"));
  EXPECT_EQ(read_text("a.json", geojson_of("a")).source.advice.up, FormatAdvice().up);
}

std::string text_of(const char* document) {
  std::ostringstream text;
  text << std::ifstream(std::filesystem::path(FARLOD_SOURCE_DIR) / document).rdbuf();
  return std::move(text).str();
}

/// The documents that list formats, and the programs that cannot ask for the table, name those of the table.
TEST(InputFormats, AreThoseOfTheDocuments) {
  const std::string ingest = text_of("docs/stages/ingest.md");
  for (const InputFormat& format : input_formats()) {
    if (format.is_this == nullptr) continue;
    const std::string name(format.name);
    const std::size_t row = ingest.find("\n| " + name);
    ASSERT_NE(row, ingest.npos) << name;
    const std::string line = ingest.substr(row + 1, ingest.find('\n', row + 1) - row);
    for (const FormatEnding& ending : format.endings)
      if (!ending.text.empty()) {
        EXPECT_THAT(line, HasSubstr("`" + std::string(ending.text) + "`")) << name;
      }
    for (const char* document : {"README.md", "qgis/farlod/pack.py", "python/src/farlod/_packing.py"})
      EXPECT_THAT(text_of(document), HasSubstr(name)) << document;
  }
  const auto is_piped = [](const InputFormat& format) { return format.is_piped; };
  EXPECT_THAT(ingest, HasSubstr("for the standard input: " + names_where(is_piped, " or ")));
}

}  // namespace
}  // namespace farlod::ingest::test
