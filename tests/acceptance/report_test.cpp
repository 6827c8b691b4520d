// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "console/exit_code.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

/// Two sound blocks, a tree, one block without a height, and one with height 0.
std::string town_with_problems() {
  nlohmann::json town = nlohmann::json::parse(footprints_geojson({{"a", {}, 20.0, 10.0},
                                                                  {"b", {60.0, 0.0}, 20.0, 10.0},
                                                                  {"unknown", {120.0, 0.0}, 20.0, 10.0},
                                                                  {"flat", {180.0, 0.0}, 20.0, 0.0}}));
  town["features"][2]["properties"]["height"] = nullptr;
  town["features"].push_back({{"type", "Feature"},
                              {"properties", {{"id", "tree"}, {"height", 12.0}}},
                              {"geometry", {{"type", "Point"}, {"coordinates", {town_middle.x, town_middle.y}}}}});
  return town.dump();
}

class Report : public testing::Test {
 protected:
  Report() { folder.write("town.geojson", town_with_problems()); }
  WorkFolder folder;
};

TEST_F(Report, HasAnEntryForEachProblem) {
  folder.must("farlod-pack town.geojson -o a.farlod --report r.json --summary s.json");
  const nlohmann::json report = folder.json_of("r.json");
  ASSERT_EQ(report.size(), 3U);
  std::map<std::string, int> code_of;
  for (const nlohmann::json& entry : report) {
    for (const char* key : {"code", "problem", "effect", "source", "place", "detail"}) EXPECT_TRUE(entry.contains(key)) << key;
    EXPECT_EQ(entry.at("source"), "town.geojson");
    EXPECT_EQ(entry.at("effect"), "left out");
    EXPECT_NE(entry.at("detail"), "");
    code_of[entry.at("place")] = entry.at("code");
  }
  EXPECT_EQ(code_of, (std::map<std::string, int>{{"unknown", 107}, {"tree", 108}, {"flat", 109}}));
  EXPECT_EQ(folder.json_of("s.json").at("problems"), 3);
  EXPECT_EQ(folder.json_of("s.json").at("buildings"), 2);
}

TEST_F(Report, IsCountedOnTheScreen) {
  const Outcome outcome = folder.run("farlod-pack town.geojson -o a.farlod");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(outcome.out, HasSubstr("2 buildings, 12 polygons, 3 problems"));
  for (const char* line : {"1 × 107 no_height", "1 × 108 not_an_area", "1 × 109 height_not_positive", "--report FILE.json"})
    EXPECT_THAT(outcome.out, HasSubstr(line));
}

TEST_F(Report, IsEmptyForASoundCity) {
  folder.write("sound.geojson", footprints_geojson(small_town()));
  folder.must("farlod-pack sound.geojson -o a.farlod --report r.json");
  EXPECT_EQ(folder.json_of("r.json"), nlohmann::json::array());
}

TEST_F(Report, ADefaultHeightFillsTheGap) {
  folder.must("farlod-pack town.geojson -o a.farlod --default-height 7 --summary s.json");
  EXPECT_EQ(folder.json_of("s.json").at("buildings"), 3);
}

}  // namespace
}  // namespace farlod::acceptance
