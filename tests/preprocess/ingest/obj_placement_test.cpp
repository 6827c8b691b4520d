// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/obj/obj_placement.hpp"

#include <gmock/gmock.h>

#include "archive_writer.hpp"
#include "ingest/files/input_search.hpp"
#include "reading.hpp"
#include "small_cities.hpp"

namespace farlod::ingest::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A mesh with files beside it, each test in a folder of its own.
class ObjPlaced : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }
  void SetUp() override {
    fs::remove_all(folder);
    write("model/deep/town.obj", obj_of("a"));
  }
  Reading read(const IngestSettings& settings = {}) const { return read_file(folder / "model/deep/town.obj", settings); }
  static Point3d first_corner(const Reading& r) { return r.city().ring(r.city().facets()[0], 0)[0]; }

  fs::path folder = write_file("x", "").parent_path() / "placed";
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

}  // namespace
}  // namespace farlod::ingest::test
