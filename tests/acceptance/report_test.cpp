// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
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
  town["features"][2]["properties"].erase("floors");
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
    for (const char* key : {"code", "problem", "effect", "source", "place", "ring", "position", "detail"})
      EXPECT_TRUE(entry.contains(key)) << key;
    EXPECT_EQ(entry.at("source"), "town.geojson");
    EXPECT_EQ(entry.at("effect"), "left out");
    EXPECT_NE(entry.at("detail"), "");
    code_of[entry.at("place")] = entry.at("code");
  }
  EXPECT_EQ(code_of, (std::map<std::string, int>{{"unknown", 107}, {"tree", 108}, {"flat", 109}}));
  EXPECT_EQ(folder.json_of("s.json").at("problems"), 3);
  EXPECT_EQ(folder.json_of("s.json").at("buildings"), 2);
}

nlohmann::json entry_at(const nlohmann::json& entries, const std::string& place) {
  for (const nlohmann::json& entry : entries)
    if (entry.at("place") == place) return entry;
  ADD_FAILURE() << "nothing is reported at " << place;
  return {};
}

TEST_F(Report, TellsPlacesAsTheFileHasThem) {
  folder.must("farlod-pack town.geojson -o a.farlod --report r.json");
  const nlohmann::json report = folder.json_of("r.json");
  EXPECT_EQ(entry_at(report, "tree").at("position"), nlohmann::json({town_middle.x, town_middle.y, 0.0}));
  const nlohmann::json town = nlohmann::json::parse(town_with_problems());
  for (const auto& [place, feature] : {std::pair("unknown", 2), std::pair("flat", 3)}) {
    const nlohmann::json corner = town["features"][static_cast<std::size_t>(feature)]["geometry"]["coordinates"][0][0];
    EXPECT_EQ(entry_at(report, place).at("position"), nlohmann::json({corner[0], corner[1], 0.0}));
  }
}

/// Of a position whose coordinates are whole millimetres.
constexpr double millimetre_deg = 1e-3 / 111.2e3;
/// WGS 84 on a central meridian of UTM at the northing 5,500,000 m, from the length of the meridian by numerical integration.
constexpr double town_latitude_deg = 49.652542922450685;

TEST_F(Report, IsAMapWhereItsNameSaysSo) {
  folder.must("farlod-pack town.geojson -o a.farlod --report r.geojson");
  folder.must("farlod-pack town.geojson -o b.farlod --report r.json");
  const nlohmann::json map = folder.json_of("r.geojson"), report = folder.json_of("r.json");
  EXPECT_EQ(map.at("type"), "FeatureCollection");
  EXPECT_FALSE(map.contains("crs")) << "RFC 7946 knows WGS 84 only";
  ASSERT_EQ(map.at("features").size(), report.size());
  for (std::size_t n = 0; n < report.size(); ++n) {
    const nlohmann::json& feature = map["features"][n];
    EXPECT_EQ(feature.at("type"), "Feature");
    EXPECT_EQ(feature.at("properties"), report[n]);
    EXPECT_EQ(feature.at("geometry").at("type"), "Point");
    if (report[n].at("place") != "tree") continue;
    const nlohmann::json& lon_lat = feature.at("geometry").at("coordinates");
    ASSERT_EQ(lon_lat.size(), 2U);
    EXPECT_NEAR(lon_lat[0], 9.0, millimetre_deg);
    EXPECT_NEAR(lon_lat[1], town_latitude_deg, millimetre_deg);
  }
}

TEST_F(Report, HasNoGeometryWhereNoPlaceIsKnown) {
  nlohmann::json town = nlohmann::json::parse(footprints_geojson(small_town()));
  town["features"].push_back({{"type", "Feature"}, {"properties", {{"id", "nowhere"}, {"height", 5.0}}}, {"geometry", nullptr}});
  folder.write("town.geojson", town.dump());
  folder.must("farlod-pack town.geojson -o a.farlod --report r.geojson");
  const nlohmann::json features = folder.json_of("r.geojson").at("features");
  ASSERT_EQ(features.size(), 1U);
  EXPECT_EQ(features[0].at("geometry"), nullptr);
  EXPECT_EQ(features[0].at("properties").at("position"), nullptr);
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

TEST_F(Report, StrictlyReadRefusesTheCity) {
  expect_refusal(folder.run("farlod-pack town.geojson -o a.farlod --strict --quiet --report r.json"), exit_unusable_input,
                 {"3 problems", "--strict", "no package is written", "r.json lists them"});
  EXPECT_EQ(folder.json_of("r.json").size(), 3U);
  EXPECT_FALSE(folder.has("a.farlod"));
  expect_refusal(folder.run("farlod-pack town.geojson -o a.farlod --strict --quiet"), exit_unusable_input,
                 {"3 problems", "--report FILE.json lists"});
}

TEST_F(Report, StrictlyReadKeepsTheFormerPackage) {
  folder.must("farlod-pack town.geojson -o a.farlod");
  const std::string before = folder.text_of("a.farlod/manifest.json");
  const Outcome outcome = folder.run("farlod-pack town.geojson -o a.farlod --cell 25 --force --strict");
  EXPECT_EQ(outcome.exit_code, exit_unusable_input);
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("far maps")));
  EXPECT_EQ(folder.text_of("a.farlod/manifest.json"), before);
}

TEST_F(Report, StrictlyReadPacksASoundCity) {
  folder.write("sound.geojson", footprints_geojson(small_town()));
  folder.must("farlod-pack sound.geojson -o a.farlod --strict --report r.json");
  EXPECT_TRUE(folder.has("a.farlod/manifest.json"));
  EXPECT_EQ(folder.json_of("r.json"), nlohmann::json::array());
}

TEST_F(Report, ADefaultHeightFillsTheGap) {
  folder.must("farlod-pack town.geojson -o a.farlod --default-height 7 --summary s.json");
  EXPECT_EQ(folder.json_of("s.json").at("buildings"), 3);
}

}  // namespace
}  // namespace farlod::acceptance
