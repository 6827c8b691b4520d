// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

constexpr double floor_m = 5.0, roof_m = 25.0, receiver_m = 0.05;
/// From a receiver to the roofs around it.
constexpr double rise_m = roof_m - floor_m - receiver_m;
constexpr double pixel_m = 0.25;
constexpr std::size_t rays = 20000;

/// How a surface model is read, and where its walls then have their tops: before the outermost centres of pixels of a roof.
struct Reading {
  const char* name;
  const char* arguments;
  double before_centres_m;
};

/// A city that is known only as a raster of its surface.
class SurfaceModel : public testing::Test {
 protected:
  void pack(const std::function<bool(Point2d)>& is_roof, const std::string& arguments = "") const {
    pack_heights([&](Point2d p) { return is_roof(p) ? roof_m : floor_m; }, arguments);
  }
  void pack_heights(const std::function<double(Point2d)>& height_m, const std::string& arguments = "") const {
    constexpr double half_edge_m = 40.0;
    folder.write("dsm.asc", ascii_grid(height_m, pixel_m, half_edge_m));
    folder.must("farlod-pack --terrain dsm.asc --crs EPSG:32632 --force -o a.farlod " + arguments + " > said.txt 2>&1");
  }
  [[nodiscard]] CsvTable table_at(Point2d p, const std::string& engine) const {
    std::ostringstream command;
    command << "farlod-svf a.farlod -o at.csv --at " << text_of(town_middle + p) << " --on-surface --height " << receiver_m
            << " --rays " << rays << " --engine " << engine;
    folder.must(command.str());
    return CsvTable(folder.text_of("at.csv"));
  }
  [[nodiscard]] double svf_at(Point2d p, const std::string& engine) const { return table_at(p, engine).number(0, "svf"); }
  [[nodiscard]] std::string said() const { return folder.text_of("said.txt"); }

  WorkFolder folder;
};

/// farlod-info counted no building in it, and far maps that are missing.
TEST_F(SurfaceModel, IsDescribedAsOne) {
  pack([](Point2d p) { return norm(p) >= 25.0; });
  const std::string city = folder.run("farlod-info a.farlod").out;
  EXPECT_THAT(city, testing::HasSubstr("City          a surface model of "));
  EXPECT_THAT(city, testing::HasSubstr("; buildings are a part of it"));
  for (const char* of_buildings : {"0 buildings", "Streets"}) EXPECT_THAT(city, testing::Not(testing::HasSubstr(of_buildings)));
  pack_heights([](Point2d p) { return floor_m + 0.3 * std::sin(31.0 * p.x) * std::cos(17.0 * p.y); });
  const std::string rough = folder.run("farlod-info a.farlod").out;
  EXPECT_THAT(rough, testing::HasSubstr("Far maps      none, and none is missing: rays march over the pixels"));
}

/// It said "0 buildings" and "Streets: 0.00°", and no height.
TEST_F(SurfaceModel, IsToldByTheHeightsOfItsWalls) {
  pack([](Point2d p) { return norm(p) >= 25.0; }, "--summary said.json");
  EXPECT_THAT(said(), testing::HasSubstr("A surface model; buildings are a part of it, 0 problems\n"));
  EXPECT_THAT(said(), testing::HasSubstr("Heights of walls: least 20.0 m, median 20.0 m, tallest 20.0 m\n"
                                         "Ground and roofs: 5.0 m to 25.0 m, from the surface model\n"));
  EXPECT_THAT(said(), testing::Not(testing::HasSubstr("Streets")));
  const auto looks = folder.json_of("said.json").at("looks");
  EXPECT_EQ(looks.at("heights_m").at("median"), 20.0);
  EXPECT_EQ(looks.at("ground_m"), (nlohmann::json{{"low", 5.0}, {"high", 25.0}, {"from", "surface model"}}));
  pack_heights([](Point2d p) { return 0.5 * p.x; });
  EXPECT_THAT(said(), testing::HasSubstr("A surface model without walls, 0 problems\n"));
  EXPECT_THAT(said(), testing::HasSubstr("Heights of walls: none"));
  EXPECT_THAT(said(), testing::HasSubstr("Ground: -20.0 m to 20.0 m"));
}

/// They were packed with 0 problems.
TEST_F(SurfaceModel, OfOtherUnitsAndQuantitiesIsDoubted) {
  const auto in_cm = [](Point2d p) { return std::fmod(std::abs(p.x), 20.0) > 10.0 ? 2500.0 : 500.0; };
  pack_heights(in_cm, "--report report.json");
  EXPECT_THAT(said(), testing::HasSubstr("Doubtful (208 implausible_size): dsm.asc: its heights, from 500 m to 2500 m"));
  const auto problem = folder.json_of("report.json").at(0);
  EXPECT_EQ(problem.at("place"), "the whole file");
  EXPECT_EQ(problem.at("position").at(2), 2500.0);
  EXPECT_TRUE(problem.at("lon_lat").is_array());
  pack_heights([](Point2d p) { return 0.5 + 0.5 * std::sin(0.1 * p.x) * std::cos(0.1 * p.y); });
  EXPECT_THAT(said(), testing::HasSubstr("Doubtful (208 implausible_size): dsm.asc: its heights lie between 0.0"));
  EXPECT_EQ(folder.run("farlod-pack --terrain dsm.asc --crs EPSG:32632 -o b.farlod --strict").exit_code, exit_unusable_input);
}

/// It was said before the work, and at the end again.
TEST_F(SurfaceModel, ADoubtIsPrintedOnce) {
  pack_heights([](Point2d p) { return 0.5 + 0.5 * std::sin(0.1 * p.x) * std::cos(0.1 * p.y); });
  const std::string all = said(), detail = "dsm.asc: its heights lie between 0.0";
  EXPECT_EQ(all.find(detail), all.rfind(detail)) << all;
  EXPECT_THAT(all, testing::HasSubstr("1 × 208 implausible_size: "));
  EXPECT_THAT(all, testing::HasSubstr("(kept; doubted above)"));
}

/// It said "1 inside buildings or without ground".
TEST_F(SurfaceModel, APlaceBesideItIsToldWhereTheCityLies) {
  pack([](Point2d p) { return norm(p) >= 25.0; });
  for (const std::string output : {"o.csv", "o.svg"})
    expect_refusal(folder.run("farlod-svf a.farlod --at 500090,5500000 -o " + output), exit_unusable_input,
                   {"500090, 5500000 has none (there is no ground)", "It lies outside of the city, which lies from 4999",
                    " in WGS 84 / UTM zone 32N: check --at"});
}

/// They were a pit of 22 m, without a word.
TEST_F(SurfaceModel, HasNoPitWhereZerosStandForNoData) {
  pack_heights([](Point2d p) {
    const bool is_empty = p.x > 10.0 && p.y > 10.0, is_roof = std::fmod(std::abs(p.x), 20.0) > 15.0;
    return is_empty ? 0.0 : 22.0 + 0.01 * (p.x + 40.0) + (is_roof ? 9.0 : 0.0);
  });
  EXPECT_THAT(said(), testing::HasSubstr("211 undeclared_no_data"));
  EXPECT_THAT(said(), testing::HasSubstr("           dsm.asc: 0 is no height here, and counts as no data ("));
  EXPECT_THAT(said(), testing::HasSubstr(" pixels here, the first at "));
  EXPECT_THAT(said(), testing::HasSubstr("Ground and roofs: 22.0 m to "));
}

class SurfaceModelRead : public SurfaceModel, public testing::WithParamInterface<Reading> {};

TEST_P(SurfaceModelRead, RectangularCourt) {
  constexpr double a = 10.0, b = 25.0;  // half the edges of what roofs leave free, by the centres of their pixels
  pack([](Point2d p) { return std::abs(p.x) >= a || std::abs(p.y) >= b; }, GetParam().arguments);
  const double half_x = a - GetParam().before_centres_m, half_y = b - GetParam().before_centres_m;
  // The opening is convex, and so is its picture on the unit disk: no longer than the circle
  const double sampling = sampling_error(rays, 2.0 * oracles::pi);
  // A corner may be cut off by half a pixel, which is seen from right below at best
  const double corners = 4.0 * 0.5 * pixel_m * pixel_m / (oracles::pi * rise_m * rise_m);
  for (const Point2d p : {Point2d{}, {4.0, 0.0}, {-7.0, 12.5}, {6.25, -20.0}}) {
    double expected = 0.0;
    for (const double to_x : {half_x - p.x, half_x + p.x})
      for (const double to_y : {half_y - p.y, half_y + p.y}) expected += oracles::court_quadrant_cos(to_x, to_y, rise_m);
    for (const char* engine : {"auto", "exact"})
      EXPECT_NEAR(svf_at(p, engine), expected, sampling + corners) << p.x << ' ' << p.y << ' ' << engine;
  }
}

TEST_P(SurfaceModelRead, RoundCourt) {
  constexpr double radius_m = 25.0;
  pack([](Point2d p) { return norm(p) >= radius_m; }, GetParam().arguments);
  // The centres of roof pixels lie outside of the circle; a corner of a pixel, or what joins two neighbors by a chord, reaches
  // into it. A point that is farther than a pixel's diagonal outside has roof pixels all around
  const double diagonal_m = std::sqrt(2.0) * pixel_m;
  const double chord_m = diagonal_m * diagonal_m / (8.0 * radius_m);
  const double least_radius_m = radius_m - std::max(chord_m, std::sqrt(2.0) * GetParam().before_centres_m),
               largest_radius_m = radius_m + diagonal_m;
  // Stairs around a circle are no longer than the square around it, and the unit disk shows them smaller by the rise at least
  const double sampling = sampling_error(rays, 8.0 * largest_radius_m / rise_m);
  for (const Point2d p : {Point2d{}, {10.0, 0.0}, {-6.0, 8.0}, {0.0, -20.0}})
    for (const char* engine : {"auto", "exact"}) {
      const double svf = svf_at(p, engine);
      EXPECT_GE(svf, oracles::round_court_cos(least_radius_m, rise_m, norm(p)) - sampling) << p.x << ' ' << p.y;
      EXPECT_LE(svf, oracles::round_court_cos(largest_radius_m, rise_m, norm(p)) + sampling) << p.x << ' ' << p.y;
    }
}

TEST_P(SurfaceModelRead, OnARoofThereIsNothingAbove) {
  pack([](Point2d p) { return norm(p) >= 25.0; }, GetParam().arguments);
  for (const Point2d p : {Point2d{30.0, 0.0}, {-32.5, 31.0}}) EXPECT_EQ(svf_at(p, "exact"), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Readings, SurfaceModelRead,
                         testing::Values(Reading{"Walls", "", 0.5 * pixel_m}, Reading{"Tin", "--surface tin", 0.0}),
                         [](const auto& reading) { return std::string(reading.param.name); });

TEST_F(SurfaceModel, TellsWhatStandsBetweenItsPixels) {
  const auto is_roof = [](Point2d p) { return p.x > 0.0; };
  pack(is_roof);
  EXPECT_NE(said().find("walls stand on 321 sides of pixels"), std::string::npos) << said();
  pack(is_roof, "--surface tin");
  EXPECT_EQ(said().find("walls stand"), std::string::npos) << said();
  pack_heights([](Point2d p) { return 0.5 * p.x; });
  EXPECT_EQ(said().find("walls stand"), std::string::npos) << said();
  folder.write("town.geojson", footprints_geojson(small_town()));
  folder.must("farlod-pack town.geojson --surface tin -o b.farlod > said.txt 2>&1");
  EXPECT_NE(said().find("--surface is for a raster"), std::string::npos) << said();
}

/// A quarter of the outermost pixels lies beyond all centres.
TEST_F(SurfaceModel, WithWallsCoversWholePixels) {
  const Point2d in_corner{-40.0 - 0.4 * pixel_m, 40.0 + 0.4 * pixel_m};
  pack([](Point2d p) { return p.x > 0.0; });
  EXPECT_EQ(table_at(in_corner, "auto").text(0, "svf").empty(), false);
  pack([](Point2d p) { return p.x > 0.0; }, "--surface tin");
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --on-surface --at " + text_of(town_middle + in_corner)),
                 exit_unusable_input, {"there is no ground"});
}

TEST_F(SurfaceModel, AnswersItsOwnPixelsUnlessOthersAreAskedFor) {
  pack([](Point2d p) { return norm(p) >= 25.0; });
  const RasterFile surface = read_raster(folder.path("dsm.asc"));
  EXPECT_THAT(folder.run("farlod-svf a.farlod -o own.tif --height 0.05").out,
              testing::HasSubstr("are answered, 0.05 m above its surface (--height)"));
  const RasterFile own = read_raster(folder.path("own.tif"));
  ASSERT_EQ(std::pair(own.columns, own.rows), std::pair(surface.columns, surface.rows));
  EXPECT_EQ(own.step_m, surface.step_m);
  EXPECT_EQ(own.north_west.x, surface.north_west.x);
  EXPECT_EQ(own.north_west.y, surface.north_west.y);
  folder.must("farlod-svf a.farlod -o like.tif --grid-like dsm.asc --height 0.05");
  EXPECT_EQ(own.values, read_raster(folder.path("like.tif")).values);
  EXPECT_TRUE(std::all_of(own.values.begin(), own.values.end(), [](const auto& value) { return value.has_value(); }));
}

TEST_F(SurfaceModel, ABoxLeavesThoseOfItsPixelsThatItMeets) {
  pack([](Point2d p) { return norm(p) >= 25.0; });
  std::ostringstream box;
  box << std::fixed << town_middle.x - 1.0 << ',' << town_middle.y - 1.0 << ',' << town_middle.x + 1.1 << ','
      << town_middle.y + 30.0;
  folder.must("farlod-svf a.farlod -o part.tif --bbox " + box.str());
  const RasterFile part = read_raster(folder.path("part.tif"));
  // Sides of pixels lie an eighth of a metre beside their centres, at whole quarters
  EXPECT_EQ(std::pair(part.columns, part.rows), std::pair(std::size_t{9}, std::size_t{125}));
  EXPECT_EQ(part.north_west.x, town_middle.x - 1.125);
  EXPECT_EQ(part.north_west.y, town_middle.y + 30.125);
  EXPECT_NE(folder.run("farlod-svf a.farlod -o none.tif --bbox 1,1,5,5").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path("none.tif")));
}

/// They said that no pixel lies in the city, and that there is nothing of what was asked for.
TEST_F(SurfaceModel, SaysThatItKnowsNoBuildings) {
  pack([](Point2d p) { return norm(p) >= 25.0; });
  for (const std::string asked :
       {"-o o.asc --grid 1 --within 3", "-o o.csv --surfaces walls", "-o o.csv --surfaces all --dry-run"})
    expect_refusal(folder.run("farlod-svf a.farlod " + asked), exit_unusable_input,
                   {asked.find("within") == std::string::npos ? "--surfaces" : "--within",
                    "this package is a surface model, which does not tell buildings from ground", "Pack footprints"});
}

/// A survey of hills as it comes from a scanner, with some huts: no two pixels have the same height.
double survey_m(Point2d p) {
  const double noise_m = 0.03 * (std::sin(12.9898 * p.x + 78.233 * p.y) + std::sin(93.17 * p.x - 41.3 * p.y));
  const bool is_hut = std::fmod(std::abs(p.x) + 2.0, 20.0) > 17.0 && std::fmod(std::abs(p.y) + 2.0, 16.0) > 13.0;
  return floor_m + 4.0 * std::sin(0.3 * p.x) * std::cos(0.2 * p.y) + noise_m + (is_hut ? 5.0 : 0.0);
}

class Survey : public SurfaceModel {
 protected:
  void SetUp() override { pack_heights(survey_m); }
  [[nodiscard]] RasterFile map(const std::string& arguments) const {
    folder.must("farlod-svf a.farlod -o map.tif --height 1.5 " + arguments);
    return read_raster(folder.path("map.tif"));
  }
  /// A square around the middle.
  [[nodiscard]] static std::string box(double half_edge_m) { return " --bbox " + corners(half_edge_m); }
  [[nodiscard]] static std::string corners(double half_edge_m) {
    std::ostringstream text;
    text << std::fixed << town_middle.x - half_edge_m << ',' << town_middle.y - half_edge_m << ',' << town_middle.x + half_edge_m
         << ',' << town_middle.y + half_edge_m;
    return text.str();
  }
};

TEST_F(Survey, IsMarchedOverAsRaysTellIt) {
  const RasterFile marched = map(box(5.0)), traced = map(box(5.0) + " --engine exact --rays 20000");
  ASSERT_EQ(marched.values.size(), traced.values.size());
  double sum = 0.0, largest = 0.0;
  for (std::size_t n = 0; n < traced.values.size(); ++n) {
    ASSERT_EQ(marched.values[n].has_value(), traced.values[n].has_value());
    const double error = std::abs(*marched.values[n] - *traced.values[n]);
    sum += error;
    largest = std::max(largest, error);
  }
  EXPECT_LE(sum / static_cast<double>(traced.values.size()), 0.0005);
  EXPECT_LE(largest, 0.004);
}

TEST_F(Survey, NeedsNoFarMaps) {
  EXPECT_NE(said().find("no far maps are made"), std::string::npos) << said();
  folder.must("farlod-info a.farlod > info.txt");
  EXPECT_NE(folder.text_of("info.txt").find("none, and none is missing"), std::string::npos) << folder.text_of("info.txt");
  folder.must("farlod-svf a.farlod -o march.tif --summary march.json" + box(3.0));
  EXPECT_NE(folder.text_of("march.json").find("\"receivers_by_rays\": 0"), std::string::npos);
  // What edges tell needs them where it is asked
  folder.must("farlod-pack --terrain dsm.asc --crs EPSG:32632 --force -o b.farlod --area " + corners(6.0) + " > said.txt 2>&1");
  EXPECT_EQ(said().find("no far maps are made"), std::string::npos) << said();
}

/// Receivers stand anywhere in their pixels, and look anywhere.
TEST_F(Survey, IsMarchedOverFromAnyPlaceAsRaysTellIt) {
  std::ostringstream points;
  points << std::fixed << "x,y,azimuth,tilt\n";
  for (int n = 0; n < 200; ++n)
    points << town_middle.x + 9.0 * std::sin(1.3 * n) << ',' << town_middle.y + 9.0 * std::cos(0.7 * n) << ',' << (37 * n) % 360
           << ',' << (n % 2 == 0 ? 0 : (11 * n) % 90) << '\n';
  folder.write("points.csv", points.str());
  folder.must("farlod-svf a.farlod -o marched.csv --points points.csv --height 1.5");
  folder.must("farlod-svf a.farlod -o traced.csv --points points.csv --height 1.5 --engine exact --rays 20000");
  const CsvTable marched(folder.text_of("marched.csv")), traced(folder.text_of("traced.csv"));
  for (std::size_t n = 0; n < 200; ++n) EXPECT_NEAR(marched.number(n, "svf"), traced.number(n, "svf"), 0.004) << n;
  const RasterFile grid = map("--grid 0.4" + box(3.0)), of_rays = map("--grid 0.4 --engine exact --rays 20000" + box(3.0));
  ASSERT_EQ(grid.values.size(), of_rays.values.size());
  for (std::size_t n = 0; n < grid.values.size(); ++n) EXPECT_NEAR(*grid.values[n], *of_rays.values[n], 0.004) << n;
}

TEST_F(Survey, HorizonsOfEdgesAreThoseOfTheMarch) {
  // Bounds are those of edges, where there are far maps
  const RasterFile marched = map(box(5.0));
  folder.must("farlod-pack --terrain dsm.asc --crs EPSG:32632 --force -o a.farlod --area " + corners(6.0));
  folder.must("farlod-svf a.farlod -o bounded.tif --height 1.5 --bounds" + box(5.0));
  const RasterFile low = read_raster(folder.path("bounded.tif"), 2), high = read_raster(folder.path("bounded.tif"), 3);
  std::size_t outside = 0;
  for (std::size_t n = 0; n < marched.values.size(); ++n)
    outside += *marched.values[n] < *low.values[n] - 0.001 || *marched.values[n] > *high.values[n] + 0.001 ? 1 : 0;
  EXPECT_EQ(outside, 0U);
}

TEST_F(Survey, APixelHasOneValueWhateverElseIsAsked) {
  const RasterFile all = map(""), part = map(box(7.3));
  for (std::size_t n = 0; n < part.values.size(); n += 7)
    EXPECT_EQ(part.values[n].value(), all.at(part.centre_of(n)).value()) << n;
  // As a point among others, of which most stand between centres
  const Point2d centre = part.centre_of(part.values.size() / 2);
  std::ostringstream points;
  points << std::fixed << "x,y\n" << centre.x + 0.06 << ',' << centre.y << "\n" << centre.x << ',' << centre.y << '\n';
  folder.write("points.csv", points.str());
  folder.must("farlod-svf a.farlod -o points_svf.csv --points points.csv --height 1.5");
  EXPECT_NEAR(CsvTable(folder.text_of("points_svf.csv")).number(1, "svf"), all.at(centre).value(), 1e-5);
}

TEST_F(Survey, OtherQuantitiesComeFromTheSameHorizons) {
  // Seven azimuths, none of which runs through the corners of pixels, where a ray may take either side of a hut
  const std::string command = "farlod-svf a.farlod --height 1.5 --quantity directional --horizons 7" + box(3.0) + " -o ";
  folder.must(command + "marched.tif");
  folder.must(command + "traced.tif --engine exact --rays 20000");
  const std::vector<std::string> bands = band_names(folder.path("marched.tif"));
  ASSERT_EQ(bands, band_names(folder.path("traced.tif")));
  ASSERT_EQ(bands.size(), 12U);
  for (std::size_t band = 1; band <= bands.size(); ++band) {
    const RasterFile marched = read_raster(folder.path("marched.tif"), static_cast<int>(band)),
                     traced = read_raster(folder.path("traced.tif"), static_cast<int>(band));
    double sum = 0.0;
    for (std::size_t n = 0; n < marched.values.size(); ++n) sum += std::abs(*marched.values[n] - *traced.values[n]);
    // Horizons are degrees
    const double tolerance = bands[band - 1].starts_with("horizon") ? 0.05 : 0.001;
    EXPECT_LE(sum / static_cast<double>(marched.values.size()), tolerance) << bands[band - 1];
  }
}

}  // namespace
}  // namespace farlod::acceptance
