// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

/// A ray in a thousand may pass on the other side of an edge when the scene's corners round otherwise.
constexpr double one_ray = 1.0 / static_cast<double>(default_rays) + half_of_last_digit;

std::vector<std::string> places() {
  std::vector<std::string> result;
  for (const Point2d p : {Point2d{-60.0, 0.0}, {0.0, 0.0}, {30.0, -60.0}, {120.0, 95.0}})
    result.push_back(text_of(p_projected(p)));
  return result;
}

TEST_F(PackedTown, BuildingsAssignedWholeAreTheSameCity) {
  folder.must("farlod-pack town.geojson -o whole.farlod --assign whole --summary s.json");
  for (const std::string& place : places())
    EXPECT_NEAR(svf_at(place, "--engine exact", "whole.farlod"), svf_at(place, "--engine exact"), one_ray) << place;
  // Uncut, the town has fewer pieces
  folder.must("farlod-pack town.geojson -o clip.farlod --assign clip --summary c.json");
  EXPECT_LT(folder.json_of("s.json").at("triangles"), folder.json_of("c.json").at("triangles"));
  EXPECT_EQ(folder.json_of("s.json").at("polygons"), folder.json_of("c.json").at("polygons"));
}

TEST_F(PackedTown, BuildingsAssignedWholeGiveAlmostTheSameMap) {
  folder.must("farlod-pack town.geojson -o whole.farlod --assign whole");
  folder.must("farlod-svf whole.farlod -o whole.asc --grid 5 --verify 200 --summary whole.json");
  folder.must("farlod-svf a.farlod -o clip.asc --grid 5 --verify 200 --summary clip.json");
  const RasterFile whole = raster("whole.asc"), clip = raster("clip.asc");
  ASSERT_EQ(whole.values.size(), clip.values.size());
  for (std::size_t n = 0; n < clip.values.size(); ++n) {
    ASSERT_EQ(whole.values[n].has_value(), clip.values[n].has_value()) << n;
    // Each is within the paper's error of the truth
    if (clip.values[n]) {
      EXPECT_NEAR(*whole.values[n], *clip.values[n], 2.0 * paper_error) << n;
    }
  }
  for (const char* summary : {"whole.json", "clip.json"})
    EXPECT_LT(folder.json_of(summary).at("verify").at("max_abs_error"), paper_error) << summary;
}

TEST_F(PackedTown, TurningTheGridChangesNoAnswer) {
  const std::pair<std::string, double> turns[]{{"none", 0.0}, {"33.5", 33.5}, {"-70", -70.0}};
  for (const auto& [align, rotation_deg] : turns) {
    folder.must("farlod-pack town.geojson -o turned.farlod --force --summary s.json --align " + align);
    EXPECT_NEAR(folder.json_of("s.json").at("grid_rotation_deg"), rotation_deg, 1e-9);
    for (const std::string& place : places())
      EXPECT_NEAR(svf_at(place, "--engine exact", "turned.farlod"), svf_at(place, "--engine exact"), 2.0 * one_ray)
          << align << ' ' << place;
  }
}

TEST_F(PackedTown, AnotherCrsIsTheSameTownElsewhereOnPaper) {
  folder.must("farlod-pack town.geojson -o zone33.farlod --out-crs EPSG:25833 --summary s.json");
  // Town and streets are turned by the meridian convergence of zone 33 at 9° E: atan(tan(6°) · sin(49.65°)), the town's latitude
  const double convergence_deg =
      Angle::radians(std::atan(std::tan(Angle::degrees(6.0).radians()) * std::sin(Angle::degrees(49.652).radians()))).degrees();
  const double hundredth = 0.01;  // what the streets' direction is found to
  EXPECT_NEAR(folder.json_of("s.json").at("grid_rotation_deg"), town_bearing.degrees() + convergence_deg, hundredth);
#ifdef FARLOD_WITH_GDAL
  folder.must("farlod-svf zone33.farlod -o o.tif --grid 4");
  EXPECT_EQ(raster("o.tif").epsg, 25833);
  folder.write("p.csv", "lon,lat\n9,49.652\n9,49.6527\n");
  folder.must("farlod-svf zone33.farlod -o zone33.csv --points p.csv --points-crs EPSG:4326 --engine exact");
  folder.must("farlod-svf a.farlod -o zone32.csv --points p.csv --points-crs EPSG:4326 --engine exact");
  // Twelve degrees of longitude hold the scale to 0.2 %, heights do not scale along: the horizon's tangent is off by as much
  const double border = 4.0 * std::numbers::pi, scale_error = 0.002;
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_NEAR(table("zone33.csv").number(n, "svf"), table("zone32.csv").number(n, "svf"),
                2.0 * sampling_error(default_rays, border) + scale_error);
#endif
}

TEST_F(PackedTown, CellsAndNeighborhoodsAreAsAsked) {
  folder.must("farlod-pack town.geojson -o b.farlod --cell 20 --neighborhood 5 --summary s.json");
  const nlohmann::json summary = folder.json_of("s.json");
  EXPECT_EQ(summary.at("cell_m"), 20.0);
  EXPECT_EQ(summary.at("neighborhood"), 5);
  // The town is 336 m from the first wall to the last: 17 or 18 cells of 20 m each way
  EXPECT_GE(summary.at("cells"), 17 * 17);
  EXPECT_LE(summary.at("cells"), 18 * 18);
}

TEST(MeshWithAnOrigin, LiesWhereTheOriginSays) {
  const WorkFolder folder;
  folder.write("box.obj", box_obj());
  folder.must("farlod-pack box.obj --crs EPSG:32632 --origin 1000,2000,30 -o a.farlod");
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs");
  const CsvTable points(folder.text_of("o.csv"));
  for (std::size_t n = 0; n < points.size(); ++n) {
    EXPECT_GT(points.number(n, "x_m"), 501000.0);
    EXPECT_LT(points.number(n, "x_m"), 501020.0);
    EXPECT_GT(points.number(n, "y_m"), 5502000.0);
    EXPECT_LT(points.number(n, "y_m"), 5502020.0);
    EXPECT_EQ(points.number(n, "z_m"), 40.01);
  }
}

/// Two sound blocks, a tree, one block without a height, and one with height 0.
std::string town_with_problems() {
  nlohmann::json town = nlohmann::json::parse(footprints_geojson({{"a", {}, 20.0, 10.0},
                                                                  {"b", {60.0, 0.0}, 20.0, 10.0},
                                                                  {"unknown", {120.0, 0.0}, 20.0, 10.0},
                                                                  {"flat", {180.0, 0.0}, 20.0, 0.0}}));
  town["features"][2]["properties"]["height"] = nullptr;
  for (const int n : {2, 3}) town["features"][n]["properties"].erase("floors");
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
    for (const char* key : {"code", "problem", "effect", "source", "place", "ring", "position", "lon_lat", "detail"})
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
    EXPECT_EQ(report[n].at("lon_lat"), lon_lat);
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
  for (const char* key : {"position", "lon_lat"}) EXPECT_EQ(features[0].at("properties").at(key), nullptr) << key;
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

TEST_F(Report, TellsOnTheTerminalWhichOfTwoCrsIsUsed) {
  const Outcome outcome = folder.run("farlod-pack town.geojson --crs EPSG:25832 -o a.farlod");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 × 203 two_crs"));
  EXPECT_THAT(outcome.out,
              testing::ContainsRegex("town.geojson: the file says EPSG:32632 .*; --crs says EPSG:25832 .*, which is used"));
}

TEST_F(Report, TellsWhichShareOfTheGridTheTerrainCovers) {
  folder.write("sound.geojson", footprints_geojson(small_town()));
  folder.write("west.asc", ascii_grid([](Point2d p) { return p.x < 0.0 ? 100.0 : -9999.0; }));
  const Outcome half = folder.run("farlod-pack sound.geojson --terrain west.asc -o a.farlod");
  EXPECT_THAT(
      half.out,
      testing::ContainsRegex(
          "The terrain has heights under (1[0-9]|2[0-9]) of 36 buildings, and for (4[5-9]|5[0-5]) % of the box around them; "
          "elsewhere the ground is as high as the nearest of them: --terrain takes several"));
  folder.write("all.asc", ascii_grid([](Point2d) { return 100.0; }));
  const Outcome all = folder.run("farlod-pack sound.geojson --terrain all.asc -o a.farlod --force");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_THAT(all.out, testing::Not(HasSubstr("The terrain has heights for")));
}

TEST_F(Report, ADefaultHeightFillsTheGap) {
  folder.must("farlod-pack town.geojson -o a.farlod --default-height 7 --summary s.json");
  EXPECT_EQ(folder.json_of("s.json").at("buildings"), 4) << "0 is no height either";
}

}  // namespace
}  // namespace farlod::acceptance
