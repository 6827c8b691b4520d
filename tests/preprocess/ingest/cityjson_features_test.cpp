// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "ingest/files/input_search.hpp"
#include "reading.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using testing::HasSubstr;

const std::string metadata = R"({"type":"CityJSON","version":"2.0","CityObjects":{},"vertices":[],)"
                             R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/28992"},)"
                             R"("transform":{"scale":[0.5,0.5,0.5],"translate":[10,20,30]}})";

std::string feature_called(const std::string& id) {
  return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{")" + id +
         R"(":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2.2","boundaries":[[[0,1,2,3]]]}]}},)"
         R"("vertices":[[0,0,0],[2,0,0],[2,2,0],[0,2,0]]})"
         "\n";
}

/// Writes a file below the folder of the running test.
std::filesystem::path write_below(const std::string& folder, const std::string& name, const std::string& text) {
  const std::filesystem::path root = write_file("root", "").parent_path();
  std::filesystem::create_directories(root / folder);
  std::ofstream(root / folder / name, std::ios::binary) << text;
  return root / folder / name;
}

TEST(CityJsonFeatures, TakeTheirHeaderFromTheMetadataBesideThem) {
  write_file("metadata.json", metadata);
  const Reading r = read_text("a.city.jsonl", feature_called("a") + feature_called("b"));
  ASSERT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[2], (Point3d{11, 21, 30}));
  EXPECT_EQ(r.source.crs.definition, "https://www.opengis.net/def/crs/EPSG/0/28992");
  EXPECT_TRUE(r.codes().empty());
  ASSERT_TRUE(r.source.placed);
  EXPECT_EQ(r.source.placed->format, package::CityFileFormat::cityjsonseq);
}

TEST(CityJsonFeatures, OrFromThatOfAFolderAbove) {
  write_file("metadata.json", metadata);
  const auto file = write_below("objects/a/reconstruct", "a.city.jsonl", feature_called("a"));
  EXPECT_EQ(read_file(file).city().ring(read_file(file).city().facets()[0], 0)[2], (Point3d{11, 21, 30}));
  EXPECT_NE(scenes::refusal_of<InputError>([&] { (void)read_file(write_below("a/b/c/d", "a.city.jsonl", feature_called("a"))); }),
            "");
}

TEST(CityJsonFeatures, AreRefusedWithoutAHeader) {
  const std::string refusal = scenes::refusal_of<InputError>([] { (void)read_text("a.city.jsonl", feature_called("a")); });
  EXPECT_THAT(refusal, HasSubstr("a.city.jsonl holds a CityJSONFeature, which has its transform in the first line"));
  EXPECT_THAT(refusal, HasSubstr("metadata.json"));
  // The metadata of other things is no header
  write_file("metadata.json", R"({"type":"Collection"})");
  EXPECT_EQ(scenes::refusal_of<InputError>([] { (void)read_text("a.city.jsonl", feature_called("a")); }), refusal);
}

TEST(CityJsonFeatures, OfAFolderHaveAHeaderThatIsNoCity) {
  write_below("city", "metadata.json", metadata);
  for (const std::string id : {"a", "b"}) write_below("city/objects", id + ".city.jsonl", feature_called(id));
  const std::vector<std::filesystem::path> inputs{
      write_below("city/objects", "c.city.json", feature_called("c")).parent_path().parent_path()};
  Report report;
  const FoundInputs found = find_input_files(inputs, report);
  EXPECT_EQ(found.files.size(), 4u);
  const std::vector<SourceCity> cities = ingest_all(found.files, {}, report);
  ASSERT_EQ(cities.size(), 3u);
  EXPECT_EQ(cities[2].city.ring(cities[2].city.facets()[0], 0)[0], (Point3d{10, 20, 30}));
  EXPECT_TRUE(report.problems().empty()) << report.problems()[0].detail;
}

TEST(CityJsonFeatures, AHeaderAloneHoldsNoBuilding) {
  const std::vector<InputFile> twice(2, InputFile(write_file("metadata.json", metadata)));
  Report report;
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)ingest_all(twice, {}, report); }),
              HasSubstr("metadata.json holds no Building"));
}

}  // namespace
}  // namespace farlod::ingest::test
