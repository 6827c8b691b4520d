// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The small town with cells of 20 m, whole as `a.farlod`, and as `part.farlod` with far maps for a part.
class TownWithAnArea : public testing::Test {
 protected:
  TownWithAnArea() {
    add_packed_town(folder, "small_cells", small_town(), "--cell 20");
    folder.must("farlod-pack town.geojson -o part.farlod --cell 20 --quiet --area " + text_of(south_west) + "," +
                text_of(north_east));
  }
  /// Of all bands. The files as a whole differ, since they name their package and their settings.
  [[nodiscard]] std::vector<std::optional<double>> values_in(const std::string& file) const {
    std::vector<std::optional<double>> values;
    for (std::size_t band = 1; band <= band_names(folder.path(file)).size(); ++band) {
      const RasterFile raster = read_raster(folder.path(file), static_cast<int>(band));
      values.insert(values.end(), raster.values.begin(), raster.values.end());
    }
    return values;
  }
  [[nodiscard]] std::string area() const { return text_of(south_west) + "," + text_of(north_east); }

  Point2d south_west = town_middle + Point2d{-90.0, -60.0}, north_east = town_middle + Point2d{-10.0, 40.0};
  WorkFolder folder;
};

/// Each engine that has a horizon or a ray to lose, in the area and beside it.
TEST_F(TownWithAnArea, AnswersInTheAreaAreThoseOfTheWholePackage) {
  for (const std::string what : {"", " --engine rays", " --bounds", " --max-error 0.01 --bounds", " --engine horizon"}) {
    const std::string map = " --grid 4 --quiet --bbox " + area() + what;
    folder.must("farlod-svf a.farlod -o whole.tif" + map);
    folder.must("farlod-svf part.farlod -o part.tif" + map);
    EXPECT_EQ(values_in("whole.tif"), values_in("part.tif")) << what;
  }
}

TEST_F(TownWithAnArea, AnswersElsewhereAreExact) {
  const std::string far_from_it = " --grid 4 --quiet --bbox " + text_of(town_middle + Point2d{60.0, 80.0}) + "," +
                                  text_of(town_middle + Point2d{100.0, 120.0});
  folder.must("farlod-svf part.farlod -o exact.tif --engine exact" + far_from_it);
  for (const std::string engine : {"", " --engine rays"}) {
    folder.must("farlod-svf part.farlod -o part.tif --summary s.json" + far_from_it + engine);
    EXPECT_EQ(values_in("exact.tif"), values_in("part.tif")) << engine;
    EXPECT_EQ(folder.json_of("s.json").at("receivers_without_far_map"), folder.json_of("s.json").at("receivers"));
    EXPECT_GT(folder.json_of("s.json").at("receivers"), 10);
  }
  folder.must("farlod-svf a.farlod -o whole.tif" + far_from_it);
  EXPECT_NE(values_in("exact.tif"), values_in("whole.tif")) << "horizons and rays round alike: this test sees nothing";
}

TEST_F(TownWithAnArea, BoundsOfExactAnswersAreEqual) {
  folder.write("p.csv", "x,y\n" + text_of(p_projected({120.0, 90.0})) + "\n");
  folder.must("farlod-svf part.farlod -o p_out.csv --points p.csv --bounds --quiet");
  const CsvTable answers(folder.text_of("p_out.csv"));
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_LT(answers.number(0, "svf"), 1.0);
  EXPECT_EQ(answers.number(0, "svf_low"), answers.number(0, "svf"));
  EXPECT_EQ(answers.number(0, "svf_high"), answers.number(0, "svf"));
}

TEST_F(TownWithAnArea, SaysHowManyReceiversHaveNoFarMap) {
  Outcome outcome = folder.run("farlod-svf part.farlod -o o.asc --grid 10 --summary s.json");
  const auto summary = folder.json_of("s.json");
  EXPECT_LT(summary.at("receivers_without_far_map"), summary.at("receivers"));
  EXPECT_THAT(outcome.out,
              HasSubstr(summary.at("receivers_without_far_map").dump() + " receivers lie in cells without a far map"));
  outcome = folder.run("farlod-svf a.farlod -o o.asc --grid 10 --summary s.json");
  EXPECT_EQ(folder.json_of("s.json").at("receivers_without_far_map"), 0);
  EXPECT_THAT(outcome.out, Not(HasSubstr("without a far map")));
}

TEST_F(TownWithAnArea, SurfacesAndVerificationWorkOnAllCells) {
  folder.must("farlod-svf part.farlod -o walls.csv --surfaces walls --spacing 8 --verify 50 --summary s.json --quiet");
  const auto summary = folder.json_of("s.json");
  EXPECT_GT(summary.at("receivers_without_far_map"), 0);
  EXPECT_LT(summary.at("verify").at("max_abs_error"), 0.02);
}

TEST_F(TownWithAnArea, TheEngineHorizonSendsNoRays) {
  expect_refusal(folder.run("farlod-svf part.farlod -o o.asc --grid 10 --engine horizon"), exit_unusable_input,
                 {"needs a far map", "--area", "engine auto"});
  EXPECT_FALSE(folder.has("o.asc"));
}

TEST_F(TownWithAnArea, TheMemoryOfTheWholeCityIsAskedForBefore) {
  expect_refusal(folder.run("farlod-svf part.farlod -o o.asc --grid 10 --threads 1 --memory-limit 94"), exit_limit_reached,
                 {"tracing the whole city", "cells without a far map"});
  folder.must("farlod-svf a.farlod -o o.asc --grid 10 --threads 1 --memory-limit 94");
}

TEST_F(TownWithAnArea, AFileSaysTheSameAsARectangle) {
  const Point2d a = south_west, b = north_east;
  const auto corner = [](double x, double y) { return "[" + std::to_string(x) + "," + std::to_string(y) + "]"; };
  folder.write("area.geojson",
               R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32632"}},)"
               R"("features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)" +
                   corner(a.x, a.y) + "," + corner(b.x, a.y) + "," + corner(b.x, b.y) + "," + corner(a.x, b.y) + "," +
                   corner(a.x, a.y) + "]]}}]}");
  folder.must("farlod-pack town.geojson -o by_file.farlod --cell 20 --quiet --area area.geojson");
  folder.must("diff -r part.farlod by_file.farlod");
}

TEST_F(TownWithAnArea, SaysHowManyFarMapsThereAre) {
  const Outcome outcome = folder.run("farlod-pack town.geojson -o part.farlod --cell 20 --summary s.json --area " +
                                     text_of(town_middle) + "," + text_of(town_middle + Point2d{1.0, 1.0}));
  const auto summary = folder.json_of("s.json");
  EXPECT_LT(summary.at("cells_with_far_map"), summary.at("cells"));
  EXPECT_THAT(outcome.out,
              HasSubstr("Far maps: " + summary.at("cells_with_far_map").dump() + " of " + summary.at("cells").dump() + " cells"));
}

TEST_F(TownWithAnArea, AnotherCityIsRefused) {
  expect_refusal(folder.run("farlod-pack town.geojson -o part.farlod --cell 25 --area " + area()), exit_unusable_input,
                 {"part.farlod is not the package of these inputs and options", "grid.cell_m", "--force"});
  folder.must("farlod-pack town.geojson -o part.farlod --cell 25 --force --quiet --area " + area());
}

TEST_F(TownWithAnArea, WrongAreasAreRefused) {
  const auto with = [&](const std::string& text) { return folder.run("farlod-pack town.geojson -o n.farlod --area " + text); };
  expect_refusal(with("1,2,3"), exit_usage, {"--area", "give X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1"});
  expect_refusal(with("3,2,1,4"), exit_usage, {"--area", "X0 < X1"});
  expect_refusal(with("1,2,3,4,"), exit_usage, {"--area", "not of the form X0,Y0,X1,Y1"});
  expect_refusal(with("1,2,x,4"), exit_usage, {"--area", "not of the form X0,Y0,X1,Y1"});
  expect_refusal(with("1,2,3,1e300"), exit_usage, {"--area", "lies nowhere on Earth"});
  expect_refusal(with("''"), exit_usage, {"--area", "empty"});
  const Outcome beside = with("1,2,3,4");
  EXPECT_EQ(beside.exit_code, exit_usage);
  EXPECT_THAT(beside.err,
              AllOf(HasSubstr("meets no cell of the grid"), HasSubstr("from 1.0,2.0 to 3.0,4.0"), HasSubstr("UTM zone 32N")));
  expect_refusal(with("lost.gpkg"), exit_unusable_input, {"lost.gpkg cannot be read as an area"});
  EXPECT_FALSE(folder.has("n.farlod"));
}

TEST_F(TownWithAnArea, AReaderOfVersion6IsTold) {
  EXPECT_EQ(folder.json_of("part.farlod/manifest.json").at("version"), 10);
  EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("version"), 10);
}

}  // namespace
}  // namespace farlod::acceptance
