// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "reading.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

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

}  // namespace
}  // namespace farlod::ingest::test
