// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <fstream>

#include "farlod/error.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

const std::string height_in_chinese = "\xe9\xab\x98\xe5\xba\xa6";

/// A Shapefile with one house and a field of that name in GBK, which nothing in its files tells.
std::filesystem::path shapefile_in_gbk(const std::filesystem::path& folder, const std::string& name = height_in_chinese,
                                       const std::vector<std::string>& ids = {"a"}) {
  GDALAllRegister();
  const std::filesystem::path path = folder / "a.shp";
  const GDALDatasetUniquePtr dataset(
      GetGDALDriverManager()->GetDriverByName("ESRI Shapefile")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  CPLStringList options(CSLSetNameValue(nullptr, "ENCODING", "GBK"), TRUE);
  OGRLayer* layer = dataset->CreateLayer("a", nullptr, wkbPolygon, options.List());
  OGRFieldDefn field(name.c_str(), OFTReal), id_field("id", OFTString);
  EXPECT_EQ(layer->CreateField(&field), OGRERR_NONE);
  EXPECT_EQ(layer->CreateField(&id_field), OGRERR_NONE);
  for (const std::string& id : ids) {
    OGRFeature house(layer->GetLayerDefn());
    house.SetField(0, 12.0);
    house.SetField(1, id.c_str());
    OGRGeometry* outline = nullptr;
    EXPECT_EQ(OGRGeometryFactory::createFromWkt("POLYGON((0 0,0 10,10 10,10 0,0 0))", nullptr, &outline), OGRERR_NONE);
    house.SetGeometryDirectly(outline);
    EXPECT_EQ(layer->CreateFeature(&house), OGRERR_NONE);
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

}  // namespace
}  // namespace farlod::ingest::test
