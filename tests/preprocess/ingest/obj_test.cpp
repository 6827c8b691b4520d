// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <oneapi/tbb/task_arena.h>

#include <sstream>

#include "archive_writer.hpp"
#include "base/cancellation.hpp"
#include "ingest/files/input_search.hpp"
#include "ingest/mesh/mesh_classes.hpp"
#include "ingest/obj/obj_scanner.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string its_faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST(Obj, GroupsAreBuildings) {
  const Reading r = read_text("a.obj", tetrahedron + "g east wing\nf 1 3 2\nf 1 2 4\ng west\nf 2 3 4\nf 3 1 4\n");
  ASSERT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().buildings()[0].id, "east wing");
  EXPECT_EQ(r.city().buildings()[1].facet_count, 2u);
  EXPECT_TRUE(r.codes().empty());
}

TEST(Obj, ObjectsAreBuildingsAndTheirGroupsAreNot) {
  const Reading r =
      read_text("a.obj", tetrahedron + "o one\ng roof\nf 1 3 2\ng wall\nf 1 2 4\no two\ng roof\nf 2 3 4\ng wall\nf 3 1 4\n");
  ASSERT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().buildings()[1].id, "two");
}

TEST(Obj, WithoutGroupsBuildingsAreWhatHangsTogether) {
  const std::string second = "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 5 6 7\n";
  const Reading r = read_text("a.obj", tetrahedron + second + its_faces);
  ASSERT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().buildings()[0].facet_count, 1u);
  EXPECT_EQ(r.city().buildings()[1].facet_count, 4u);
}

TEST(Obj, NamesOfGroundAndTreesAreNoBuildings) {
  for (const char* name : {"Terrain", "water_1", "Road.002", "TINRelief"})
    EXPECT_EQ(class_of_name(name), MeshClass::ground) << name;
  for (const char* name : {"Forest", "tree 17"}) EXPECT_EQ(class_of_name(name), MeshClass::other) << name;
  for (const char* name : {"", "Building", "Water Street 5", "roadhouse", "NL.Pand.00", "Terrain house"})
    EXPECT_EQ(class_of_name(name), MeshClass::building) << name;
  const std::string corners = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 5\n";
  const Reading r = read_text("a.obj", corners +
                                           "o Terrain_1\nf 1 2 3\no house\nusemtl wall\nf 1 2 4\nf 2 3 4\nusemtl Road\nf 1 3 2\n"
                                           "o Tree_5\nf 1 2 4\n");
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().buildings()[0].id, "house");
  EXPECT_EQ(r.city().buildings()[0].facet_count, 2u);
  EXPECT_EQ(r.source.relief_points.size(), 6u);
  EXPECT_EQ(r.source.skipped.at("faces of tree"), 1u);
}

TEST(Obj, ToleratesAllWaysOfWriting) {
  const Reading r = read_text("a.OBJ",
                              "# a comment\r\nmtllib x.mtl\r\nv\t+0 0 0.0e0 1.0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0 # corner\r\n"
                              "vt 0 0\r\nvn 0 0 1\r\nf 1/1/1 2//1 \\\r\n  3/1 -1\r\n");
  ASSERT_EQ(r.city().facets().size(), 1u);
  const auto ring = r.city().ring(r.city().facets()[0], 0);
  EXPECT_EQ(std::vector<Point3d>(ring.begin(), ring.end()), (std::vector<Point3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_TRUE(r.codes().empty());
}

TEST(Obj, IsTurnedUprightAndThenMoved) {
  IngestSettings settings;
  settings.up = UpAxis::y;
  settings.obj_origin = {100, 200, 300};
  const Reading r = read_text("a.obj", "v 0 0 0\nv 1 2 3\nv 0 1 0\nf 1 2 3\n", settings);
  const auto ring = r.city().ring(r.city().facets()[0], 0);
  EXPECT_EQ(ring[0], (Point3d{100, 200, 300}));
  EXPECT_EQ(ring[1], (Point3d{101, 197, 302}));
  EXPECT_EQ(ring[2], (Point3d{100, 200, 301}));
}

TEST(Obj, CoplanarTrianglesShareASurface) {
  const Reading r = read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 2 5\n");
  EXPECT_EQ(r.city().facets().size(), 3u);
  EXPECT_EQ(surface_count(r.city()), 2u);
}

TEST(Obj, TheReferenceSystemLiesBeside) {
  const std::filesystem::path file = write_file("a.obj", tetrahedron + its_faces);
  write_file("a.prj", "LOCAL_CS[\"here\"]");
  const Reading r = read_file(file);
  EXPECT_EQ(r.source.crs.definition, "LOCAL_CS[\"here\"]");
  EXPECT_TRUE(r.source.crs.longitude_first);
}

TEST(Obj, FacesWithoutNumbersAndLinesAreReported) {
  const Reading r = read_text("a.obj", tetrahedron + its_faces + "f one two three\nl 1 2\n");
  EXPECT_EQ(r.codes(), (std::set<int>{112, 113}));
  EXPECT_EQ(r.city().facets().size(), 4u);
}

/// A mesh with files beside it, each test in a folder of its own.
class ObjPlaced : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const { return own.write(name, text); }
  void SetUp() override { write("model/deep/town.obj", obj_of("a")); }
  Reading read(const IngestSettings& settings = {}) const { return read_file(folder / "model/deep/town.obj", settings); }
  static Point3d first_corner(const Reading& r) { return r.city().ring(r.city().facets()[0], 0)[0]; }

  const scenes::TemporaryFolder own;
  const fs::path folder = own.path();
};

TEST_F(ObjPlaced, ByNothing) {
  EXPECT_EQ(first_corner(read()), (Point3d{0, 0, 0}));
  EXPECT_TRUE(read().source.notes.empty());
}

TEST_F(ObjPlaced, ByThreeNumbers) {
  for (const char* name : {"town.offset", "town_offset.xyz", "offset.xyz"}) {
    const fs::path file = write(std::string("model/deep/") + name, "500000.25 5400000.5\t-3\r\n");
    EXPECT_EQ(first_corner(read()), (Point3d{500000.25, 5400000.5, -3})) << name;
    EXPECT_THAT(read().source.notes, ElementsAre(HasSubstr(name)));
    fs::remove(file);
  }
}

TEST_F(ObjPlaced, ByNoFileThatIsSomethingElse) {
  for (const char* text : {"1 2", "1 2 3 4", "1 2 x", "1 2 nan", "", "1,2,3a"}) {
    write("model/deep/offset.xyz", text);
    EXPECT_EQ(first_corner(read()), (Point3d{0, 0, 0})) << text;
  }
}

TEST_F(ObjPlaced, ByOpenDroneMap) {
  write("model/odm_georeferencing/coords.txt", "WGS84 UTM 17S\n512000 8765000\n1.5 2.5 100\n");
  EXPECT_EQ(first_corner(read()), (Point3d{512000, 8765000, 0}));
  EXPECT_EQ(read().source.crs.definition, "EPSG:32717");
  EXPECT_EQ(read().source.notes.size(), 2u);
  // The model that ODM does not call "geo" has no place
  const Reading local = read_file(write("model/deep/odm_textured_model.obj", obj_of("a")));
  EXPECT_EQ(first_corner(local), (Point3d{0, 0, 0}));
}

TEST_F(ObjPlaced, ByContextCapture) {
  write("metadata.xml",
        "<?xml version=\"1.0\"?>\n<ModelMetadata version=\"1\">\n<SRS>EPSG:32632</SRS>\n<SRSOrigin>1,2,3</SRSOrigin>\n"
        "</ModelMetadata>");
  EXPECT_EQ(first_corner(read()), (Point3d{1, 2, 3}));
  EXPECT_EQ(read().source.crs.definition, "EPSG:32632");
  write("model/deep/metadata.xml", "<MD_Metadata/>");
  EXPECT_EQ(first_corner(read()), (Point3d{1, 2, 3})) << "metadata of another kind";
}

TEST_F(ObjPlaced, ByWhatTheUserSaysFirst) {
  write("model/deep/town.offset", "1 2 3");
  write("model/deep/town.prj", "EPSG:25832");
  write("model/deep/coords.txt", "WGS84 UTM 32N\n7 8\n");
  EXPECT_EQ(read().source.crs.definition, "EPSG:25832");
  EXPECT_EQ(first_corner(read()), (Point3d{1, 2, 3}));
  IngestSettings settings;
  settings.obj_origin = Point3d{0, 0, 10};
  EXPECT_EQ(first_corner(read(settings)), (Point3d{0, 0, 10}));
  EXPECT_THAT(read(settings).source.notes, ElementsAre(HasSubstr("town.prj"), HasSubstr("is not used")));
}

TEST_F(ObjPlaced, WithinAnArchiveAndBesideAPackedFile) {
  const fs::path zip =
      write("town.zip", zip_of({{"a/town.obj", obj_of("a")}, {"a/town.offset", "1 2 3"}, {"a/town.prj", "EPSG:25832"}}));
  write("town.offset", "4 5 6");
  const fs::path gzip = write("town.obj.gz", gzip_of(obj_of("a")));
  Report report;
  const std::vector<SourceCity> cities = ingest_all(find_input_files(std::vector{zip, gzip}, report).files, {}, report);
  ASSERT_EQ(cities.size(), 2u);
  EXPECT_EQ(cities[0].crs.definition, "EPSG:25832");
  EXPECT_EQ(cities[0].city.points()[0], (Point3d{1, 2, 3}));
  EXPECT_EQ(cities[1].city.points()[0], (Point3d{4, 5, 6}));
}

/// All that lines may say to each other: names, numbers that count backwards, lines that go on.
const std::string every_way =
    "\xEF\xBB\xBF# all of it\r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no first\ng\n\nv 0 0 1\nf -4 -3 -1\nl 1 2\n"
    "g north wing\nf 1 \\\n  2 \\ \r\n -1\nv 1 1 \\\n1\nf -1 1 2 x\nf 0 -9 7\n\\\n\np 1\no second\nf -2 -1 1\nf -1/1 2/2 3/3 # "
    "\\\n"
    "f 2 3 4\ng north wing\n v\t5 x 5\nf 1 2 -1\nf a b c\nv 9 9 9 \\";

/// What a mesh holds, as text.
std::string described(const Mesh& mesh) {
  std::ostringstream text;
  for (const Point3d& p : mesh.vertices) text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const MeshFace& face : mesh.faces) {
    text << "f of line " << face.line << " in " << face.group << ' ' << mesh.groups[face.group] << ", " << face.object << ' '
         << mesh.objects[face.object] << ':';
    for (std::size_t k = 0; k < face.corner_count; ++k) text << ' ' << mesh.corners[face.first_corner + k];
    text << '\n';
  }
  text << mesh.corners.size() << " corners, " << mesh.groups.size() << " groups, " << mesh.objects.size() << " objects\n";
  for (const std::uint64_t line : mesh.malformed_lines) text << "malformed " << line << '\n';
  text << mesh.unread_elements << " unread from " << mesh.first_unread_line << '\n';
  return text.str();
}

std::string scan(const std::string& text, std::size_t segment_bytes, int threads) {
  std::istringstream stream(text);
  return oneapi::tbb::task_arena(threads).execute([&] { return described(scan_obj(stream, {}, segment_bytes)); });
}

TEST(ObjSegments, MakeTheFileWhenPutTogether) {
  for (const std::size_t bytes : {1U, 2U, 3U, 7U, 20U, 64U, 10'000U}) {
    std::istringstream stream(every_way);
    ObjSegmentCutter cutter(stream, bytes);
    std::string text;
    for (auto segment = cutter.next(); segment; segment = cutter.next()) {
      EXPECT_FALSE(segment->empty());
      text += *segment;
    }
    EXPECT_EQ(text, every_way.substr(3)) << bytes;
  }
}

TEST(ObjSegments, EndWithALineThatIsNotContinued) {
  std::istringstream stream("v 1 \\\n 2 3\nf 1 \\ \r\n2\nf\n");
  ObjSegmentCutter cutter(stream, 1);
  std::vector<std::string> segments;
  for (auto segment = cutter.next(); segment; segment = cutter.next()) segments.push_back(*segment);
  EXPECT_THAT(segments, testing::ElementsAre("v 1 \\\n 2 3\n", "f 1 \\ \r\n2\n", "f\n"));
}

TEST(ObjSegments, SayTogetherWhatTheFileSays) {
  const std::string whole = scan(every_way, every_way.size(), 1);
  EXPECT_THAT(whole, testing::HasSubstr("f of line 15 in 2 north wing, 1 first: 0 1 3\n"));
  EXPECT_THAT(whole, testing::HasSubstr("f of line 24 in 2 north wing, 2 second: 3 4 0\n"));
  EXPECT_THAT(whole, testing::HasSubstr("malformed 18\nmalformed 30\n2 unread from 11\n"));
  for (std::size_t bytes = 1; bytes < every_way.size(); bytes += 3)
    for (const int threads : {1, 4}) EXPECT_EQ(scan(every_way, bytes, threads), whole) << bytes;
}

TEST(ObjSegments, AreNoneOfAnEmptyFile) {
  EXPECT_EQ(scan("", 10, 4), described(Mesh()));
  EXPECT_EQ(scan("\xEF\xBB\xBF", 10, 4), described(Mesh()));
}

TEST(ObjSegments, EndWhenAStopIsRequested) {
  std::istringstream stream(every_way);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW((void)scan_obj(stream, stop.get_token()), Cancelled);
}

/// Several batches of buildings, in which something is wrong here and there.
std::string houses(int count) {
  std::string text = "v 0 0 0\nv 9 0 0\nv 0 9 0\n";
  for (int n = 0; n < count; ++n) {
    const std::string x = std::to_string(n % 97), y = std::to_string(n / 97);
    text += "g " + (n % 500 == 499 ? "the same" : "house " + std::to_string(n)) + "\n";
    text += "v " + x + " " + y + " 0\nv " + x + ".5 " + y + " 0\nv " + x + " " + y + ".5 0\nv " + x + " " + y + " 7\n";
    text += "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -2 -4 -1\n";
    if (n % 300 == 7) text += "f 1 2 99999999\nf -1 -1 -2\nf x\n";
    if (n % 700 == 8) text += "g broken\nf 0 1 2\n";
    if (n % 400 == 9) text += "f -4 -2 -3\n";
  }
  return text;
}

TEST(ObjBuildings, DoNotDependOnThreads) {
  const std::filesystem::path file = write_file("a.obj", houses(3'000));
  const auto read_on = [&](int threads) { return oneapi::tbb::task_arena(threads).execute([&] { return read_file(file); }); };
  const Reading one = read_on(1);
  EXPECT_EQ(one.city().buildings().size(), 3'000U);
  EXPECT_EQ(one.report.count(ProblemCode::repeated_id), 5U + 4U);
  EXPECT_EQ(one.report.count(ProblemCode::vertex_index_out_of_range), 10U + 5U);
  EXPECT_EQ(one.report.count(ProblemCode::duplicate_surface), 8U);
  for (const int threads : {2, 5}) {
    const Reading several = read_on(threads);
    EXPECT_EQ(test::described(several.source, several.report), test::described(one.source, one.report));
  }
}

}  // namespace
}  // namespace farlod::ingest::test
