// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

/// The least that a town around its middle can be: nothing of it rises above a receiver.
std::string flat_town() { return footprints_geojson({{"slab", {60.0, 60.0}, 10.0, 0.1}, {"step", {-60.0, -60.0}, 10.0, 0.1}}); }

/// Level ground, and from a distance on a plateau: seen from the middle, its edge is the horizon.
std::string plateau(double from_m, double height_m, double step_m, double half_m) {
  return ascii_grid([=](Point2d p) { return norm(p) < from_m ? 100.0 : 100.0 + height_m; }, step_m, half_m);
}

/// Of light, for standard refraction: what lies so far away seems lower by this.
double expected_sinking_m(double distance_m) { return 0.87 * distance_m * distance_m / (2.0 * 6371008.8); }

class FarTerrain : public testing::Test {
 protected:
  FarTerrain() { folder.write("slab.geojson", flat_town()); }
  void pack(const std::string& arguments) const {
    folder.must("farlod-pack slab.geojson --cell 50 -o a.farlod --summary p.json " + arguments);
  }
  [[nodiscard]] CsvTable at_middle(const std::string& arguments) const {
    folder.must("farlod-svf a.farlod --at " + text_of(town_middle) + " --height 0.5 -o at.csv " + arguments);
    return CsvTable(folder.text_of("at.csv"));
  }
  WorkFolder folder;
};

TEST_F(FarTerrain, AllEnginesSeeARidgeAllAround) {
  folder.write("terrain.asc", plateau(1500.0, 600.0, 20.0, 2400.0));
  pack("--terrain terrain.asc");
  for (const std::string engine : {"auto", "horizon", "rays", "exact"}) {
    const CsvTable answer = at_middle("--engine " + engine + " --rays 20000 --quantity horizon");
    // The edge runs along pixels: between the last one of the ground and the first of the plateau
    const double slope = 600.0 / 1510.0, expected = 1.0 / (1.0 + slope * slope);
    EXPECT_NEAR(answer.number(0, "svf"), expected, 0.003) << engine;
    for (const char* azimuth : {"horizon_000", "horizon_090", "horizon_180", "horizon_270"})
      EXPECT_NEAR(answer.number(0, azimuth), Angle::radians(std::atan(slope)).degrees(), 0.4) << engine << azimuth;
  }
}

TEST_F(FarTerrain, IsRaisedAsTheTerrainIs) {
  folder.write("low.asc", ascii_grid([](Point2d p) { return norm(p) < 1500.0 ? 60.0 : 660.0; }, 20.0, 2400.0));
  pack("--terrain low.asc --terrain-offset 40");
  const CsvTable answer = at_middle("--quantity horizon");
  EXPECT_NEAR(answer.number(0, "horizon_090"), Angle::radians(std::atan(600.0 / 1510.0)).degrees(), 0.4);
}

TEST_F(FarTerrain, BoundsHoldForIt) {
  folder.write("terrain.asc", ascii_grid(
                                  [](Point2d p) {
                                    return 100.0 + 0.2 * std::max(0.0, norm(p) - 300.0) +
                                           60.0 * std::sin(p.x / 150.0) * std::sin(p.y / 90.0) * std::min(1.0, norm(p) / 1000.0);
                                  },
                                  20.0, 2000.0));
  pack("--terrain terrain.asc");
  std::string points = "x,y\n";
  for (int n = 0; n < 200; ++n) {
    const Point2d p = town_middle + Point2d{10.0 * (n % 20) - 95.0, 20.0 * (n / 20) - 95.0};
    points += text_of(p) + "\n";
  }
  folder.write("points.csv", points);
  folder.must("farlod-svf a.farlod --points points.csv --bounds --rays 500 --engine rays -o rays.csv");
  folder.must("farlod-svf a.farlod --points points.csv --bounds --engine exact --rays 1 -o exact.csv");
  const CsvTable rays(folder.text_of("rays.csv")), exact(folder.text_of("exact.csv"));
  ASSERT_EQ(rays.size(), exact.size());
  ASSERT_GT(rays.size(), 100U);
  for (std::size_t n = 0; n < rays.size(); ++n) {
    const double svf = exact.number(n, "svf");
    EXPECT_LT(svf, 0.98);
    EXPECT_GE(svf, rays.number(n, "svf_low"));
    EXPECT_LE(svf, rays.number(n, "svf_high"));
    EXPECT_NEAR(svf, rays.number(n, "svf"), 0.006);
  }
}

/// A slope that rises to the east far beyond the grid: whoever stood on the height at the border would lie below it.
TEST_F(FarTerrain, BeyondTheGridReceiversStandOnIt) {
  const auto height_m = [](Point2d p) { return 200.0 + 0.2 * p.x; };
  folder.write("terrain.asc", ascii_grid(height_m, 10.0, 900.0));
  pack("--terrain terrain.asc --align none");
  const Point2d low = town_middle - Point2d{250.0, 250.0}, high = town_middle + Point2d{250.0, 250.0};
  folder.must("farlod-svf a.farlod -o map.asc --grid 20 --summary s.json --bbox " + text_of(low) + "," + text_of(high));
  EXPECT_EQ(folder.json_of("s.json").at("nodata"), 0);
  const RasterFile map = read_raster(folder.path("map.asc"));
  EXPECT_GT(folder.json_of("s.json").at("receivers_outside_of_grid"), map.values.size() / 2);
  for (const std::optional<double>& svf : map.values) EXPECT_GT(svf.value(), 0.95);
  folder.write("points.csv", "x,y\n" + text_of(town_middle + Point2d{210.0, 10.0}) + "\n" +
                                 text_of(town_middle + Point2d{-230.0, 110.0}) + "\n");
  folder.must("farlod-svf a.farlod --points points.csv --bounds -o auto.csv");
  folder.must("farlod-svf a.farlod --points points.csv --engine exact --rays 20000 -o exact.csv");
  const CsvTable drawn(folder.text_of("auto.csv")), exact(folder.text_of("exact.csv"));
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    const Point2d p = Point2d{drawn.number(n, "x_m"), drawn.number(n, "y_m")};
    EXPECT_NEAR(drawn.number(n, "z_m"), height_m(p - town_middle) + 1.5, 0.5) << "two thousandths of 250 m";
    EXPECT_NEAR(drawn.number(n, "svf"), map.at(p).value(), half_of_last_digit);
    EXPECT_NEAR(drawn.number(n, "svf"), exact.number(n, "svf"), 0.003);
    EXPECT_LE(drawn.number(n, "svf_high") - drawn.number(n, "svf_low"), 0.01);
  }
}

TEST_F(FarTerrain, BeyondTheGridItIsTheHorizon) {
  folder.write("terrain.asc", plateau(1500.0, 600.0, 20.0, 2400.0));
  pack("--terrain terrain.asc --align none");
  const double slope = 600.0 / 1510.0, expected = 1.0 / (1.0 + slope * slope);
  const std::string place = text_of(town_middle + Point2d{0.0, 150.0});
  for (const std::string engine : {"auto", "horizon", "rays", "exact"}) {
    folder.must("farlod-svf a.farlod --at " + place + " --height 0.5 -o at.csv --engine " + engine + " --rays 20000");
    EXPECT_NEAR(CsvTable(folder.text_of("at.csv")).number(0, "svf"), expected, 0.01) << engine;
  }
}

TEST_F(FarTerrain, TheEarthIsRound) {
  folder.write("terrain.asc", ascii_grid([](Point2d) { return 100.0; }));
  folder.write("far.asc", plateau(50e3, 4000.0, 250.0, 60e3));
  pack("--terrain terrain.asc --far-terrain far.asc");
  const double distance_m = 50e3 + 125.0, slope = (4000.0 - expected_sinking_m(distance_m)) / distance_m;
  for (const std::string engine : {"auto", "exact"}) {
    const CsvTable answer = at_middle("--engine " + engine + " --quantity horizon");
    for (const char* azimuth : {"horizon_000", "horizon_050", "horizon_200"})
      // .2° of it are the curvature
      EXPECT_NEAR(answer.number(0, azimuth), Angle::radians(std::atan(slope)).degrees(), 0.03) << engine << azimuth;
  }
}

TEST_F(FarTerrain, IsNotThereWhereTheTerrainIs) {
  // A model of surfaces, as a coarse one is: it stands above the ground
  folder.write("terrain.asc", ascii_grid([](Point2d) { return 100.0; }, 10.0, 1000.0));
  folder.write("far.asc", ascii_grid([](Point2d) { return 115.0; }, 100.0, 5000.0));
  pack("--terrain terrain.asc --far-terrain far.asc");
  EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("problems").at("212"), 1);
  const double slope = 15.0 / 1000.0;
  EXPECT_NEAR(at_middle("--quantity horizon").number(0, "horizon_000"), Angle::radians(std::atan(slope)).degrees(), 0.12);
}

TEST_F(FarTerrain, APackageSaysWhetherItHasOne) {
  folder.write("terrain.asc", ascii_grid([](Point2d) { return 100.0; }));
  pack("--terrain terrain.asc");
  EXPECT_FALSE(folder.json_of("a.farlod/manifest.json").contains("far_terrain")) << "level ground hides nothing";
  EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("version"), 10);
  folder.write("far.asc", plateau(2000.0, 600.0, 50.0, 3000.0));
  pack("--terrain terrain.asc --far-terrain far.asc --force");
  EXPECT_TRUE(folder.json_of("a.farlod/manifest.json").contains("far_terrain"));
  EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("version"), 11);
  folder.must("farlod-info a.farlod --check");
}

TEST_F(FarTerrain, EachKindOfFarMapHasIt) {
  folder.write("terrain.asc", plateau(1500.0, 600.0, 20.0, 2400.0));
  pack("--terrain terrain.asc --far-map box");
  const double slope = 600.0 / 1510.0;
  EXPECT_NEAR(at_middle("--engine rays --rays 20000").number(0, "svf"), 1.0 / (1.0 + slope * slope), 0.01);
}

TEST_F(FarTerrain, OfAnotherLevelItIsRefused) {
  folder.write("far.asc", ascii_grid([](Point2d) { return 500.0; }, 100.0, 5000.0));
  const auto outcome = folder.run("farlod-pack slab.geojson -o a.farlod --far-terrain far.asc");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("far.asc: where the grid ends, it is 500.0 m above the ground of the city"), std::string::npos)
      << outcome.err;
}

TEST_F(FarTerrain, IsAskedWhatATerrainIs) {
  folder.write("terrain.asc", ascii_grid([](Point2d) { return 100.0; }));
  folder.write("far.asc", ascii_grid([](Point2d p) { return p.x > 1000.0 ? -32768.0 : 100.0; }, 100.0, 5000.0));
  pack("--terrain terrain.asc --far-terrain far.asc");
  EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("problems").at("211"), 1);
  const auto outcome = folder.run(
      "farlod-pack slab.geojson -o b.farlod --terrain terrain.asc --far-terrain far.asc --out-crs "
      "EPSG:32633 --crs EPSG:32601");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
}

TEST_F(FarTerrain, WhereOneHasNothingButZerosTheNextOneShows) {
  folder.write("terrain.asc", ascii_grid([](Point2d) { return 100.0; }));
  const auto half = [](double side, double height_m) {
    return ascii_grid([=](Point2d p) { return side * p.x < 0.0 ? height_m : norm(p) < 2000.0 ? 100.0 : 700.0; }, 50.0, 3000.0);
  };
  const double slope = 600.0 / 2025.0, expected = 1.0 / (1.0 + slope * slope);
  for (const double nothing : {0.0, -1.0, -32768.0}) {
    folder.write("east.asc", half(1.0, nothing));
    folder.write("west.asc", half(-1.0, nothing));
    pack("--terrain terrain.asc --far-terrain east.asc --far-terrain west.asc --force");
    EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("problems").at("211"), 2) << nothing;
    EXPECT_NEAR(at_middle("").number(0, "svf"), expected, 0.004) << nothing;
  }
}

TEST_F(FarTerrain, MayBeAFolderOfTiles) {
  folder.write("terrain.asc", ascii_grid([](Point2d) { return 100.0; }));
  std::filesystem::create_directory(folder.path("tiles"));
  folder.write("tiles/far.asc", plateau(2000.0, 600.0, 50.0, 3000.0));
  folder.write("tiles/elsewhere.asc", ascii_grid([](Point2d) { return 100.0; }, 50.0, 1000.0, town_middle - Point2d{0.0, 300e3}));
  pack("--terrain terrain.asc --far-terrain tiles/far.asc");
  const std::string of_a_file = folder.text_of("a.farlod/far_terrain.bin");
  pack("--terrain terrain.asc --far-terrain tiles --force");
  EXPECT_EQ(folder.text_of("a.farlod/far_terrain.bin"), of_a_file);
  std::filesystem::remove(folder.path("tiles/far.asc"));
  const auto outcome = folder.run("farlod-pack slab.geojson -o b.farlod --terrain terrain.asc --far-terrain tiles");
  EXPECT_NE(outcome.err.find("200 km away from the city"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.exit_code, 3);
}

TEST_F(FarTerrain, OneThatCannotBeReadIsRefused) {
  EXPECT_EQ(folder.run("farlod-pack slab.geojson -o a.farlod --far-terrain absent.tif").exit_code, 3);
}

}  // namespace
}  // namespace farlod::acceptance
