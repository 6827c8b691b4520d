// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <regex>
#include <string>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/work_folder.hpp"

// Points that lie elsewhere, that no number says where they lie, or whose height may count from elsewhere.

namespace farlod::acceptance {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// In a street of the town, and where nobody packed a city.
const Point2d street_crossing = p_projected({-60.0, 0.0}), far_field = town_middle + Point2d{10000.0, 0.0};

TEST_F(PackedTown, EveryOutputTakesAPlaceInDegreesForWhatItIs) {
  folder.must("farlod-svf a.farlod -o o.csv --summary table.json --at 9.0,49.655");
  for (const std::string output : {"o.svg", "o.png", "o.ply", "o.svg --sun 2025-06-21"}) {
    const Outcome outcome = folder.run("farlod-svf a.farlod --summary s.json --at 9.0,49.655 -o " + output);
    EXPECT_EQ(outcome.exit_code, exit_done) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("9, 49.655 was taken for longitude and latitude (WGS 84).")) << output;
    EXPECT_EQ(folder.json_of("s.json").at("svf").at("mean"), folder.json_of("table.json").at("svf").at("mean")) << output;
  }
}

TEST_F(PackedTown, EveryOutputRefusesAPlaceFarFromTheCity) {
  for (const std::string output : {"o.csv", "o.svg", "o.png"}) {
    expect_refusal(folder.run("farlod-svf a.farlod --at 1000,2000 -o " + output), exit_unusable_input,
                   {"1000, 2000 lies more than 100 km from the city"});
    expect_refusal(folder.run("farlod-svf a.farlod --at " + text_of(far_field) + " -o " + output), exit_unusable_input,
                   {"510000, 5500000 lies", "more than 200 m beyond the grid of the city", "The grid lies from", "check --at"});
    expect_refusal(folder.run("farlod-svf a.farlod --at 9.2,49.655 -o " + output), exit_unusable_input,
                   {"9.2, 49.655 (longitude and latitude of ", "more than 200 m beyond the grid of the city"});
    EXPECT_FALSE(folder.has(output));
  }
}

TEST_F(PackedTown, BoxesInDegreesAreTakenForWhatTheyAre) {
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.asc --grid 5 --bbox 8.9995,49.6525,9.0005,49.6535");
  ASSERT_EQ(outcome.exit_code, exit_done) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("--bbox 8.9995, 49.6525, 9.0005, 49.6535 was taken for longitude and latitude (WGS 84): 49"));
  const RasterFile map = raster("o.asc");
  // A degree of longitude is 72.2 km there, one of latitude 111.2 km
  EXPECT_NEAR(static_cast<double>(map.columns) * map.step_m, 72.2, 2.0 * map.step_m);
  EXPECT_NEAR(static_cast<double>(map.rows) * map.step_m, 111.2, 2.0 * map.step_m);
  EXPECT_NEAR(map.north_west.x, town_middle.x - 36.1, 7.5);
  expect_refusal(folder.run("farlod-svf a.farlod -o p.asc --grid 5 --bbox 49.6525,8.9995,49.6535,9.0005"), exit_unusable_input,
                 {"--bbox 49.6525, 8.9995, 49.6535, 9.0005 lies more than 100 km", "give the longitude before the latitude"});
}

/// Some rows have their coordinates exchanged, or in degrees, or lie nowhere on Earth.
TEST_F(PackedTown, RowsThatLieElsewhereHaveNoAnswerAndCountInNoFigure) {
  folder.write("some.csv", "id,x,y\na," + text_of(street_crossing) + "\nb," +
                               text_of(Point2d{street_crossing.y, street_crossing.x}) + "\nc,9.0,49.65\nd,1e12,0\n");
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --summary s.json --points some.csv");
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("1 receiver, "), HasSubstr(", 3 beyond the grid"),
            HasSubstr("3 of 4 points lie more than 100 km from the city and have no answer: the first is point b in row 2, at 5"),
            Not(HasSubstr("more than 200 m beyond the grid")),
            HasSubstr(" 7071 km away; with x and y exchanged it would lie at the city."), Not(HasSubstr("around the grid"))));
  const CsvTable answers = table("o.csv");
  ASSERT_EQ(answers.size(), 4U);
  for (const std::size_t n : {1U, 2U, 3U})
    for (const char* column : {"z_m", "height_above_ground_m", "svf"}) EXPECT_EQ(answers.text(n, column), "") << n;
  const nlohmann::json summary = folder.json_of("s.json");
  EXPECT_NEAR(summary.at("svf").at("mean").get<double>(), answers.number(0, "svf"), half_of_last_digit);
  EXPECT_EQ(summary.at("nodata"), 3);
  folder.write("far.csv", "x,y\n" + text_of(far_field) + "\n" + text_of(far_field) + "\n");
  for (const std::string arguments : {"-o o.csv", "-o o.csv --dry-run"})
    expect_refusal(folder.run("farlod-svf a.farlod --points far.csv " + arguments), exit_unusable_input,
                   {"point 1 at ", "as all 2 points do", "check --points"});
}

TEST_F(PackedTown, RowsOfExchangedDegreesHaveNoAnswerBesideOthers) {
  // At 139°, no latitude is: such a row cannot be projected at all
  folder.write("some.csv", "id,lon,lat\na,9.0,49.655\nb,49.6525,9.0\nc,35.9,139.6\nd,9.0,49.655\ne,9.0,49.655\n");
  for (const std::string output : {"o.csv", "o.geojson", "o.gpkg", "o.fgb", "o.nc", "o.ply", "o.glb"}) {
    const Outcome outcome = folder.run("farlod-svf a.farlod --points some.csv -o " + output);
    EXPECT_EQ(outcome.exit_code, exit_done) << outcome.err;
    EXPECT_THAT(outcome.out,
                AllOf(HasSubstr("3 receivers, "), HasSubstr("first is point c at 35.9, 139.6"),
                      HasSubstr("1 of 5 points lies more than 100 km from the city and has no answer: point b in row 2")));
  }
  EXPECT_EQ(table("o.csv").text(2, "x_m"), "");
  EXPECT_EQ(table("o.csv").text(3, "svf"), table("o.csv").text(0, "svf"));
  EXPECT_EQ(table("o.csv").header(),
            (std::vector<std::string>{"id", "lon", "lat", "reason", "x_m", "y_m", "z_m", "height_above_ground_m", "svf"}));
  EXPECT_EQ(table("o.csv").text(0, "reason"), "");
  EXPECT_EQ(table("o.csv").text(1, "reason"), "beyond the grid");
  EXPECT_EQ(table("o.csv").text(2, "reason"), "no place");
  const nlohmann::json features = folder.json_of("o.geojson").at("features");
  EXPECT_TRUE(features.at(2).at("geometry").is_null());
  EXPECT_EQ(features.at(2).at("properties").at("lat"), 139.6);
  EXPECT_TRUE(features.at(1).at("properties").at("svf").is_null());
}

TEST_F(PackedTown, RowsThatCannotBeReadStayInTheTable) {
  std::string stations = "station,x,y\n";
  for (int n = 0; n < 20; ++n)
    stations += "s" + std::to_string(n) + "," + (n == 6 ? "unknown,0" : text_of(street_crossing)) + "\n";
  folder.write("stations.csv", stations);
  folder.must("farlod-svf a.farlod -o o.csv --summary s.json --points stations.csv");
  const CsvTable answers = table("o.csv");
  ASSERT_EQ(answers.size(), 20U);
  EXPECT_EQ(answers.text(6, "id"), "s6");
  for (const char* column : {"x_m", "y_m", "z_m", "height_above_ground_m", "svf"})
    EXPECT_EQ(answers.text(6, column), "") << column;
  EXPECT_EQ(answers.text(7, "id"), "s7");
  EXPECT_NE(answers.text(7, "svf"), "");
  EXPECT_EQ(folder.json_of("s.json").at("receivers"), 19);
  EXPECT_EQ(folder.json_of("s.json").at("skipped_features"), 1);
  folder.must("farlod-svf a.farlod -o again.csv --points o.csv");
}

/// One of them looks like another CRS.
TEST_F(PackedTown, APlaceFarFromTheOthersIsToldByWhatItLooksLike) {
  const auto told_of = [&](const std::string& header, const std::string& usual, const std::string& far) {
    folder.write("some.csv", header + "\n" + usual + "\n" + far + "\n" + usual + "\n");
    return folder.run("farlod-svf a.farlod -o o.csv --points some.csv").out;
  };
  const std::string here = text_of(street_crossing);
  EXPECT_THAT(told_of("x,y", here, "9.0,49.655"), HasSubstr("point 2 in row 2, at 9, 49.655, 5"));
  EXPECT_THAT(told_of("x,y", here, "9.0,49.655"), HasSubstr("it would lie at the city as longitude and latitude."));
  EXPECT_THAT(told_of("x,y", here, "49.655,9.0"), HasSubstr("it would lie at the city as latitude and longitude."));
  EXPECT_THAT(told_of("lon,lat", "9.0,49.655", "49.655,9.0"), HasSubstr("with x and y exchanged it would lie at the city."));
  EXPECT_THAT(told_of("x,y", here, "100000,200000"), HasSubstr("check its coordinates, and whether they are in another CRS."));
  EXPECT_THAT(told_of("x,y", here, here), Not(HasSubstr("100 km")));
}

/// Empty fields did not say why.
TEST_F(PackedTown, RowsWithoutAnswersSayWhy) {
  const Point2d hall = p_projected(small_town().front().centre);
  folder.write("some.csv", "x,y,Reason\n" + text_of(hall) + ",repairs\n" + text_of(street_crossing) + ",\n");
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --points some.csv");
  EXPECT_THAT(outcome.out, HasSubstr("The field \"Reason\" of the points comes back as \"Reason_input\""));
  EXPECT_EQ(table("o.csv").text(0, "reason"), "inside a building");
  EXPECT_EQ(table("o.csv").text(0, "Reason_input"), "repairs");
  EXPECT_EQ(table("o.csv").text(1, "reason"), "");
  folder.write("twice.csv", "id,name,x,y,Name\n1,a," + text_of(street_crossing) + ",b\n");
  folder.must("farlod-svf a.farlod -o twice.gpkg --points twice.csv");
  folder.must("farlod-svf a.farlod -o twice_svf.csv --points twice.csv");
  EXPECT_EQ(table("twice_svf.csv").text(0, "name"), "a");
  EXPECT_EQ(table("twice_svf.csv").text(0, "Name_input"), "b");
  folder.write("all.csv", "x,y,Reason\n" + text_of(street_crossing) + ",repairs\n");
  folder.must("farlod-svf a.farlod -o all_svf.csv --points all.csv");
  EXPECT_EQ(table("all_svf.csv").header(),
            (std::vector<std::string>{"id", "Reason", "x_m", "y_m", "z_m", "height_above_ground_m", "svf"}));
}

class HighTown : public PackedTown {
 protected:
  HighTown() {
    folder.write("ground.asc", "ncols 2\nnrows 2\nxllcorner 499000\nyllcorner 5499000\ncellsize 1000\n100 100\n100 100\n");
    folder.must("farlod-pack town.geojson -o high.farlod --terrain ground.asc");
  }
  [[nodiscard]] Outcome heights_called(const std::string& column, const std::string& arguments = "") const {
    const std::string place = text_of(street_crossing);
    folder.write("p.csv", "id,x,y," + column + "\na," + place + ",2\nb," + place + ",10\nc," + place + ",\n");
    return folder.run("farlod-svf high.farlod -o o.csv --points p.csv " + arguments);
  }
};

TEST_F(HighTown, AColumnOfHeightsAboveGroundIsTheHeightOfEachStation) {
  for (const std::string name : {"height_above_ground_m", "height_above_ground"})
    for (const std::string arguments : {"", "--on-surface"}) {
      EXPECT_EQ(heights_called(name, arguments).exit_code, exit_done);
      EXPECT_EQ(table("o.csv").number(0, "z_m"), 102.0);
      EXPECT_EQ(table("o.csv").number(1, "height_above_ground_m"), 10.0);
      EXPECT_EQ(table("o.csv").number(2, "height_above_ground_m"), 1.5) << "as --height says";
    }
  EXPECT_LT(table("o.csv").number(0, "svf"), table("o.csv").number(1, "svf"));
  folder.write(
      "p.geojson",
      R"({"type":"Feature","properties":{"height_above_ground_m":4},"geometry":{"type":"Point","coordinates":[9.0,49.655]}})");
  folder.must("farlod-svf high.farlod -o f.csv --points p.geojson");
  EXPECT_EQ(table("f.csv").number(0, "height_above_ground_m"), 4.0);
}

TEST_F(HighTown, HeightsOfDoubtfulNamesAreToldForWhatTheyWereTaken) {
  const std::string advice = "for heights above ground name it height_above_ground_m";
  Outcome outcome = heights_called("height_m");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"height_m\" was taken for an elevation above sea level"),
                                 HasSubstr("where 2 of 2 points outside of buildings lie below the ground"), HasSubstr(advice)));
  outcome = heights_called("height");
  EXPECT_THAT(outcome.out, HasSubstr("the column \"height\" places no point: name it height_above_ground_m"));
  folder.write("p.csv", "x,y,height_m\n" + text_of(street_crossing) + ",2\n");
  expect_refusal(folder.run("farlod-svf high.farlod -o none.csv --points p.csv"), exit_unusable_input,
                 {"No receiver has an answer", "where 1 of 1 points outside of buildings lies below the ground", advice});
}

/// Whatever their heights mean: 2 m above the ground there is no answer, either.
TEST_F(HighTown, PointsInsideOfBuildingsDoNotSpeakForHeightsAboveGround) {
  const std::string of_house = text_of(p_projected(small_town().front().centre));
  folder.write("p.csv", "x,y,height_m\n" + of_house + ",2\n" + of_house + ",104\n" + text_of(street_crossing) + ",102\n");
  Outcome outcome = folder.run("farlod-svf high.farlod -o o.csv --points p.csv");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"height_m\" was taken for an elevation above sea level: for heights above"),
                                 HasSubstr("2 of 3 points have no answer"), HasSubstr("inside a building, whose top is ")));
  folder.write("p.csv", "x,y,height_m\n" + of_house + ",2\n" + of_house + ",104\n" + text_of(street_crossing) + ",2\n");
  outcome = folder.run("farlod-svf high.farlod -o none.csv --points p.csv");
  expect_refusal(outcome, exit_unusable_input, {"where 1 of 1 points outside of buildings lies below the ground"});
  folder.write("p.csv", "x,y,height_m\n" + of_house + ",104\n");
  outcome = folder.run("farlod-svf high.farlod -o none.csv --points p.csv");
  expect_refusal(outcome, exit_unusable_input,
                 {"point 1 at ", " has none (inside a building, whose top is ", "Choose other places"});
  EXPECT_THAT(outcome.err, Not(HasSubstr("was taken for an elevation")));
  folder.write("p.csv", "x,y,height_m\n" + of_house + ",104\n" + of_house + ",105\n");
  expect_refusal(folder.run("farlod-svf high.farlod -o none.csv --points p.csv"), exit_unusable_input,
                 {"none of 2 points has one; the first, point 1 at ", " (inside a building, whose top is "});
}

/// A dry run of fine pixels looks at coarser ones, and tells what the fine ones take.
TEST_F(PackedTown, WhatFinePixelsTakeIsToldBeforeTheyAreEvaluated) {
  const auto estimate_of = [&](const std::string& step) {
    const Outcome outcome = folder.run("farlod-svf a.farlod -o o.tif --dry-run --summary s.json --grid " + step);
    return std::pair(folder.json_of("s.json").at("estimate"), outcome.out);
  };
  const auto [coarse, says_little] = estimate_of("1");
  const auto [fine, says_all] = estimate_of("0.02");
  EXPECT_THAT(says_all, AllOf(HasSubstr("The raster has "), HasSubstr(" pixels ("), HasSubstr(" of 0.02 m).")));
  EXPECT_THAT(says_little, Not(HasSubstr("The raster has")));
  const double expected = 2500.0 * coarse.at("receivers").get<double>();
  EXPECT_NEAR(fine.at("receivers").get<double>(), expected, 0.05 * expected);
  EXPECT_GT(fine.at("memory_mib").get<double>(), coarse.at("memory_mib").get<double>());
}

}  // namespace
}  // namespace farlod::acceptance
