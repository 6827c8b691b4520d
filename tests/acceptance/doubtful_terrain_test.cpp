// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "base/frame.hpp"
#include "tests/acceptance/packed_town.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

/// Ground that climbs eastwards.
double climbing_m(Point2d p) { return 500.0 + 0.2 * p.x; }

/// The same with the roofs of the town on it.
double climbing_surface_m(Point2d p) {
  const Point2d p_town = GridRotation(town_bearing).grid_from_city(p);
  for (const Block& b : small_town())
    if (std::max(std::abs(p_town.x - b.centre.x), std::abs(p_town.y - b.centre.y)) < 0.5 * b.edge_m)
      return climbing_m(p) + b.height_m;
  return climbing_m(p);
}

class DoubtfulTerrain : public testing::Test {
 protected:
  DoubtfulTerrain() { folder.write("town.geojson", footprints_geojson(small_town())); }
  /// What the program says when it refuses the town with these arguments.
  [[nodiscard]] std::string refusal(const std::string& arguments) const {
    const auto outcome = folder.run("farlod-pack town.geojson -o a.farlod " + arguments);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    return outcome.err;
  }
  WorkFolder folder;
};

TEST_F(DoubtfulTerrain, ASurfaceModelIsNone) {
  folder.write("ground.asc", ascii_grid(climbing_m, 2.0, 300.0));
  folder.write("surface.asc", ascii_grid(climbing_surface_m, 2.0, 300.0));
  folder.must("farlod-pack town.geojson -o a.farlod --terrain ground.asc --strict");
  EXPECT_THAT(refusal("--force --terrain surface.asc"), HasSubstr("has roofs in it, as a surface model (DSM) does"));
}

TEST_F(DoubtfulTerrain, OneTileOfAnotherDatumIsToldOrRefused) {
  const auto east = [&](double above_m) {
    folder.write("east.asc", ascii_grid([=](Point2d p) { return p.x > 0.0 ? climbing_m(p) + above_m : -9999.0; }));
  };
  folder.write("west.asc", ascii_grid([](Point2d p) { return p.x > 100.0 ? -9999.0 : climbing_m(p); }));
  east(8.0);
  folder.must("farlod-pack town.geojson -o a.farlod --terrain west.asc --terrain east.asc");
  EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("problems").at("212"), 1);
  east(-46.0);
  EXPECT_THAT(refusal("--force --terrain west.asc --terrain east.asc"),
              HasSubstr("east.asc: where it meets west.asc, it is 46.0 m "
                        "below that"));
}

TEST_F(DoubtfulTerrain, AnOffsetIsProposedInPlaceOfTheGivenOne) {
  // Floors at 102 m
  folder.write("plain.asc", "ncols 2\nnrows 2\nxllcorner 549000\nyllcorner 5499000\ncellsize 1000\n99.1 99.1\n99.1 99.1\n");
  const std::string houses = "'" FARLOD_SOURCE_DIR "/datasets/broken/212_another_datum.city.json'";
  const Outcome outcome = folder.run("farlod-pack " + houses + " -o a.farlod --terrain plain.asc --terrain-offset -5");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("9 of 9 buildings stand 7.9 m above the ground"));
  EXPECT_THAT(outcome.out, HasSubstr("--terrain-offset 2.9 instead of -5 would raise the terrain to them"));
  // Too little for a doubt: floors of cellars lie as deep
  const Outcome cellars = folder.run("farlod-pack " + houses + " -o a.farlod --force --terrain plain.asc --terrain-offset 4.9");
  EXPECT_THAT(cellars.out, HasSubstr("from the terrain; all buildings begin 2.0 m below it"));
  EXPECT_THAT(cellars.out, testing::Not(HasSubstr("below_ground")));
}

/// Its receivers had no answer, as those of party walls.
TEST_F(DoubtfulTerrain, ABuildingBelowItIsTold) {
  // House 0 is 8 m high, on 10 m × 10 m, and 20 m west and south of the middle of the nine
  const auto mound_m = [](Point2d p) { return norm(p - Point2d{-20.0, -20.0}) < 15.0 ? 112.0 : 102.0; };
  folder.write("mound.asc", ascii_grid(mound_m, 10.0, 500.0, {550025.0, 5500025.0}));
  const std::string houses = "'" FARLOD_SOURCE_DIR "/datasets/broken/212_another_datum.city.json'";
  const Outcome outcome = folder.run("farlod-pack " + houses + " -o a.farlod --terrain mound.asc --report told.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 × 407 below_ground: most of a building is below the ground, or all of it (kept)\n"));
  EXPECT_THAT(outcome.out, HasSubstr("buildings begin 0.0 m above it (median; from 10.0 m below, house 0, to 0.0 m above, "));
  const auto told = folder.json_of("told.json");
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back()["place"], "house 0");
  EXPECT_EQ(told.back()["detail"], "its highest point is 2.000 m below the ground: its surfaces see no sky, and hide none");
}

TEST_F(DoubtfulTerrain, ASurfaceModelIsNoCanopy) {
  const auto low = [](double (*height_m)(Point2d)) { return [=](Point2d p) { return height_m(p) - 420.0; }; };
  folder.write("ground.asc", ascii_grid(low(climbing_m), 2.0, 300.0));
  folder.write("surface.asc", ascii_grid(low(climbing_surface_m), 2.0, 300.0));
  const Outcome outcome = folder.run("farlod-pack town.geojson -o a.farlod --terrain ground.asc --canopy surface.asc");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Doubtful (212 another_datum): surface.asc: "));
  EXPECT_THAT(outcome.out, HasSubstr("are they elevations (--canopy-absolute), or is it a surface model"));
}

/// It was a terrain without a word, and refused by a message about --crs.
TEST_F(DoubtfulTerrain, ARasterAmongTheInputsIsToldToBeOne) {
  folder.write("ground.asc", ascii_grid(climbing_m, 2.0, 300.0));
  const Outcome outcome = folder.run("farlod-pack town.geojson ground.asc -o a.farlod");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ground.asc is a raster beside buildings, and is taken for the terrain"));
  folder.write("far.asc", "ncols 2\nnrows 2\nxllcorner 650000\nyllcorner 5600000\ncellsize 1000\n1 2\n3 4\n");
  const Outcome far = folder.run("farlod-pack town.geojson far.asc -o b.farlod");
  EXPECT_EQ(far.exit_code, 3);
  EXPECT_THAT(far.err,
              HasSubstr("far.asc, a raster that is taken for the terrain of the buildings, does not meet the city: it lies "
                        "from 650000, 5600000 to 652000, 5602000 in "));
  EXPECT_THAT(far.err, HasSubstr("(that of the city, since the file names none); the city with its cells lies from 4"));
}

/// Its relief of metres was one of hundreds, without a word.
TEST_F(DoubtfulTerrain, CentimetresAreToldByTheSlopesBelowFootprints) {
  folder.write("ground.asc", ascii_grid([](Point2d p) { return 100.0 * (20.0 + 0.02 * p.x + 0.01 * p.y); }));
  const Outcome outcome = folder.run("farlod-pack town.geojson -o a.farlod --terrain ground.asc --report report.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ground.asc: its heights, from 1"));
  EXPECT_THAT(outcome.out, HasSubstr("below 36 buildings on "));
  EXPECT_THAT(outcome.out, HasSubstr("is the terrain in centimetres? gdal_edit.py -scale 0.01 FILE says so"));
  EXPECT_EQ(folder.json_of("report.json").at(0).at("code"), 208);
  EXPECT_TRUE(folder.json_of("report.json").at(0).at("lon_lat").is_array());
}

/// It was taken to be where the city is, without a word.
TEST_F(DoubtfulTerrain, WhatSaysNoCrsIsToldToBeTakenInThatOfTheCity) {
  folder.write("ground.asc", ascii_grid(climbing_m));
  folder.write("crowns.asc", ascii_grid([](Point2d p) { return p.x > 0.0 ? 5.0 : 0.0; }));
  folder.write("trunks.asc", ascii_grid([](Point2d) { return 1.0; }));
  folder.write("trees.csv", "x,y,height\n500030,5500010,9\n");
  const std::string pack =
      "farlod-pack town.geojson -o a.farlod --force --summary s.json --terrain ground.asc --canopy crowns.asc --trunk trunks.asc "
      "--trees trees.csv";
  const Outcome outcome = folder.run(pack);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto notes = folder.json_of("s.json").at("notes").get<std::vector<std::string>>();
  for (const std::string file : {"ground.asc", "crowns.asc", "trunks.asc", "trees.csv"}) {
    const std::string note = file + " has no CRS: taken to be in the city's, WGS 84 / UTM zone 32N";
    EXPECT_THAT(outcome.out, HasSubstr(note));
    EXPECT_THAT(notes, testing::Contains(HasSubstr(note)));
  }
  EXPECT_THAT(folder.run(pack + " --crs EPSG:32632").out, testing::Not(HasSubstr("has no CRS")));
}

TEST_F(DoubtfulTerrain, CanopiesInCentimetresAreDoubted) {
  folder.write("crowns.asc", ascii_grid([](Point2d p) { return p.x > 0.0 ? 500.0 + p.x : 0.0; }));
  folder.write("ground.asc", ascii_grid(climbing_m));
  Outcome outcome = folder.run("farlod-pack town.geojson -o a.farlod --terrain ground.asc --canopy crowns.asc");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("208 implausible_size"));
  EXPECT_THAT(outcome.out, HasSubstr(" heights of trees are more than "));
  EXPECT_THAT(outcome.out, HasSubstr("gdal_edit.py -scale 0.01 FILE says that they are centimetres"));
  std::string trees = "x,y,height\n";
  for (int n = 0; n < 12; ++n) trees += std::to_string(500000 + 10 * n) + ",5500010,900\n";
  folder.write("trees.csv", trees);
  outcome = folder.run("farlod-pack town.geojson -o b.farlod --trees trees.csv");
  EXPECT_THAT(outcome.out,
              HasSubstr("Doubtful (208 implausible_size): trees.csv: half of its 12 heights of trees are more than "));
}

TEST_F(DoubtfulTerrain, APictureIsNone) {
  std::string picture = "P6 20 20 255\n";
  for (int n = 0; n < 20 * 20 * 3; ++n) picture.push_back(static_cast<char>(n % 100));
  folder.write("picture.ppm", picture);
  folder.write("picture.wld",
               "50\n0\n0\n-50\n" + std::to_string(town_middle.x - 475.0) + "\n" + std::to_string(town_middle.y + 475.0) + "\n");
  EXPECT_THAT(refusal("--terrain picture.ppm"), HasSubstr("is a picture of red, green and blue"));
}
/// Roofs at 112 m stood 112 m high on a ground of 100 m, without a word.
TEST_F(DoubtfulTerrain, RoofElevationsTakenForHeightsAreTold) {
  std::vector<Block> raised = small_town();
  for (Block& b : raised) b.height_m += 100.0;
  folder.write("roofs.geojson", footprints_geojson(raised));
  folder.write("ground.asc", ascii_grid([](Point2d p) { return 100.0 + 0.01 * p.x; }));
  const std::string arguments = " --terrain ground.asc -o a.farlod --force";
  EXPECT_THAT(folder.run("farlod-pack town.geojson" + arguments).out, testing::Not(HasSubstr("208")));
  const Outcome outcome = folder.run("farlod-pack roofs.geojson" + arguments);
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr("elevations"));
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr("--roof-field in place of --height-field"));
}

/// Crowns of 8 m were 28 to 58 m high, without a word.
TEST_F(DoubtfulTerrain, ElevationsOfCrownsTakenForHeightsAreTold) {
  const auto ground_m = [](Point2d p) { return 35.0 + 0.02 * p.x; };
  folder.write("ground.asc", ascii_grid(ground_m));
  const auto crowns = [&](double above_m) {
    return ascii_grid([=](Point2d p) { return p.x > 0.0 ? above_m + 0.03 * p.x + 0.01 * p.y : 0.0; });
  };
  folder.write("heights.asc", crowns(8.0));
  folder.write("elevations.asc", crowns(43.0));
  const std::string pack = "farlod-pack town.geojson --terrain ground.asc -o a.farlod --force --canopy ";
  EXPECT_THAT(folder.run(pack + "heights.asc").out, testing::Not(HasSubstr("208")));
  EXPECT_THAT(folder.run(pack + "elevations.asc --canopy-absolute").out, testing::Not(HasSubstr("208")));
  const Outcome outcome = folder.run(pack + "elevations.asc");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("elevations.asc: nearly all of its heights of crowns"));
  EXPECT_THAT(outcome.out, HasSubstr("--canopy-absolute says so"));
}

/// Its heights were left out as numbers for no data, one problem each.
TEST_F(DoubtfulTerrain, CentimetresAboveAllMountainsAreRefused) {
  folder.write("ground.asc", ascii_grid([](Point2d p) { return 100.0 * (105.0 + 0.02 * p.x + 0.01 * p.y); }));
  EXPECT_THAT(refusal("--terrain ground.asc"),
              testing::AllOf(HasSubstr("ground.asc: "), HasSubstr("no elevations on land in metres"),
                             HasSubstr("gdal_edit.py -scale 0.01 FILE says that they are centimetres")));
}

}  // namespace
}  // namespace farlod::acceptance
