// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <fstream>

#include "farlod/error.hpp"
#include "ingest/trees/tree_reader.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

const std::string height_in_chinese = "\xe9\xab\x98\xe5\xba\xa6";

constexpr const char* outline_of_one = "POLYGON((0 0,0 10,10 10,10 0,0 0))";

/// A Shapefile with a field of that name in GBK, which nothing in its files tells, and a feature for each id.
std::filesystem::path shapefile_in_gbk(const std::filesystem::path& folder, const std::string& name = height_in_chinese,
                                       const std::vector<std::string>& ids = {"a"}, const char* shape = outline_of_one) {
  GDALAllRegister();
  const std::filesystem::path path = folder / "a.shp";
  const GDALDatasetUniquePtr dataset(
      GetGDALDriverManager()->GetDriverByName("ESRI Shapefile")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  CPLStringList options(CSLSetNameValue(nullptr, "ENCODING", "GBK"), TRUE);
  OGRGeometry* geometry = nullptr;
  EXPECT_EQ(OGRGeometryFactory::createFromWkt(shape, nullptr, &geometry), OGRERR_NONE);
  const OGRGeometryUniquePtr owned(geometry);
  OGRLayer* layer = dataset->CreateLayer("a", nullptr, geometry->getGeometryType(), options.List());
  OGRFieldDefn field(name.c_str(), OFTReal), id_field("id", OFTString);
  EXPECT_EQ(layer->CreateField(&field), OGRERR_NONE);
  EXPECT_EQ(layer->CreateField(&id_field), OGRERR_NONE);
  for (const std::string& id : ids) {
    OGRFeature feature(layer->GetLayerDefn());
    feature.SetField(0, 12.0);
    feature.SetField(1, id.c_str());
    EXPECT_EQ(feature.SetGeometry(geometry), OGRERR_NONE);
    EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
  }
  return path;
}

/// `language_driver`: what the table itself says of its encoding, 0 for nothing.
void forget_the_encoding(const std::filesystem::path& folder, char language_driver = '\0') {
  std::filesystem::remove(folder / "a.cpg");
  std::fstream table(folder / "a.dbf", std::ios::in | std::ios::out | std::ios::binary);
  constexpr std::streamoff its_place = 29;
  table.seekp(its_place);
  table.put(language_driver);
}

TEST(Encodings, AreAskedForBeforeAFieldIsSaidToBeMissing) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path file = shapefile_in_gbk(folder.path());
  forget_the_encoding(folder.path());
  IngestSettings settings;
  for (const std::optional<std::string>& name : {std::optional<std::string>(), std::optional(height_in_chinese)}) {
    settings.footprints.height_field = name;
    const std::string said = scenes::refusal_of<InputError>([&] { (void)read_file(file, settings); });
    EXPECT_THAT(said, testing::HasSubstr("its names and texts are not UTF-8: say what they are in, such as --encoding GBK"));
    EXPECT_NE(CPLIsUTF8(said.c_str(), -1), 0) << "nothing that a terminal cannot show";
  }
  settings.footprints.encoding = "GBK";
  EXPECT_EQ(read_file(file, settings).city().buildings().size(), 1U);
}

TEST(Encodings, AreAskedForByTheNameOfAnyBuilding) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path file = shapefile_in_gbk(folder.path(), "height", {"a", "b", height_in_chinese});
  forget_the_encoding(folder.path());
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(file); }), testing::HasSubstr("--encoding GBK"));
  IngestSettings settings;
  settings.footprints.encoding = "GBK";
  EXPECT_EQ(read_file(file, settings).city().buildings()[2].id, height_in_chinese);
}

TEST(Encodings, ThatATableStatesWronglyAreNamedWhereAFieldIsMissing) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path file = shapefile_in_gbk(folder.path());
  constexpr char latin_1 = 0x57;
  forget_the_encoding(folder.path(), latin_1);
  IngestSettings settings;
  settings.footprints.height_field = height_in_chinese;
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(file, settings); }),
              testing::HasSubstr("the encoding of their names by --encoding where they look wrong"));
  const auto geojson = write_file("a.geojson", geojson_of("a"));
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(geojson, settings); }),
              testing::Not(testing::HasSubstr("--encoding")))
      << "which is UTF-8, always";
  settings.footprints.height_field = "hoch";
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(file, settings); }),
              testing::Not(testing::HasSubstr("--encoding")));
}

TEST(Encodings, OfTreesAreThoseOfHouses) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path file = shapefile_in_gbk(folder.path(), height_in_chinese, {"a"}, "POINT(5 5)");
  forget_the_encoding(folder.path());
  TreeSettings settings;
  settings.height_field = height_in_chinese;
  Report report;
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_trees(file, settings, report); }),
              testing::HasSubstr("its names and texts are not UTF-8: say what they are in, such as --encoding GBK"));
  settings.encoding = "GBK";
  EXPECT_EQ(read_trees(file, settings, report).trees[0].height_m, 12.0F);
}

TEST(Encodings, OfTablesCanOnlyBeUtf8) {
  const auto table = write_file("trees.csv", "lon,lat,H\xf6he\n11.5,48.1,12\n");
  Report report;
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_trees(table, {}, report); }),
              testing::HasSubstr("not UTF-8: save it again as UTF-8"));
}

}  // namespace
}  // namespace farlod::ingest::test
