// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/citygml/citygml_skipped.hpp"
#include "citygml_text.hpp"
#include "farlod/error.hpp"

namespace farlod::ingest::test {
namespace {

const std::string skipped_house = building(surface("bldg:lod1MultiSurface", "a", "1"));

TEST(CityGmlSkipped, ObjectsOfOtherThemesAreCountedByName) {
  const std::string tree = within("cityObjectMember veg:SolitaryVegetationObject", surface("veg:lod2Geometry", "t", "9"));
  const std::string hedge = within("cityObjectMember veg:PlantCover", surface("veg:lod2MultiSurface", "h", "9"));
  const std::string relic = within("cityObjectMember uro:Relic uro:lod2Solid", polygon("r", "9"));
  const Reading r = read_citygml_text(model(tree + skipped_house + hedge + tree + relic));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"PlantCover", 1}, {"Relic (urn:some:ade)", 1}, {"SolitaryVegetationObject", 2}}));
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlSkipped, ExtensionsWithinABuildingAreCountedWhereTheyBegin) {
  const std::string extension = within("uro:floods uro:Flood uro:depth", "3");
  const std::string generics = within("core:externalReference core:informationSystem", "x");
  const Reading r =
      read_citygml_text(model(building(extension + generics + extension + surface("bldg:lod1MultiSurface", "a", "1"))));
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"floods (urn:some:ade)", 2}}));
}

TEST(CityGmlSkipped, ABuildingWithinAGroupIsStillABuilding) {
  const std::string group =
      within("cityObjectMember core:CityObjectGroup core:groupMember bldg:Building", surface("bldg:lod1MultiSurface", "a", "1"));
  const Reading r = read_citygml_text(model(group));
  EXPECT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"CityObjectGroup", 1}}));
}

TEST(CityGmlSkipped, ThereIsAnEndToNames) {
  std::string members;
  for (std::size_t k = 0; k < 2 * SkippedCount::most_names; ++k)
    members += within("cityObjectMember", "<uro:Thing" + std::to_string(k) + "/>");
  members += within("cityObjectMember", "<uro:Thing0/>");
  const std::string long_name = "uro:" + std::string(10'000, 'x');
  const Reading r = read_citygml_text(model(within("cityObjectMember", "<" + long_name + "/>") + members + skipped_house));
  EXPECT_EQ(r.source.skipped.size(), SkippedCount::most_names + 1);
  EXPECT_EQ(r.source.skipped.at(SkippedCount::other_names), SkippedCount::most_names + 1);
  EXPECT_EQ(r.source.skipped.at("Thing0 (urn:some:ade)"), 2u);
  for (const auto& [name, count] : r.source.skipped) EXPECT_LT(name.size(), 250u);
}

TEST(CityGmlSkipped, ACutNameKeepsWholeCharacters) {
  SkippedCount count;
  std::string name = "x";
  for (int k = 0; k < 200; ++k) name += "é";
  count.add({.space = "", .name = name, .id = {}, .href = {}, .srs_name = {}, .srs_dimension = {}, .orientation = {}});
  EXPECT_EQ(count.counts().begin()->first, name.substr(0, 199) + "...");
}

TEST(CityGmlSkipped, AFileOfOtherThemesSaysWhatItHas) {
  try {
    (void)read_citygml_text(model(within("cityObjectMember veg:PlantCover", "")));
    FAIL() << "a file without buildings and terrain";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("holds no Building"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("1 PlantCover"), std::string::npos);
  }
}

}  // namespace
}  // namespace farlod::ingest::test
