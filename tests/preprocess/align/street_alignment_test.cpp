// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "align/align.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "georeference/georeference.hpp"
#include "tests/preprocess/align/extruded_town.hpp"
#include "tests/scenes/test_data.hpp"

namespace farlod::align {
namespace {

/// Directions of walls of 12 m between coordinates below 1,024 m, whose last bit is 1.2e-13 m, and sums of 400 of them.
constexpr double rounding_rad = 2.0 * 1.2e-13 / 12.0 + 400.0 * 2.3e-16;

CityModel town_at(Angle bearing) {
  CityModel city;
  add_quarter(city, 40, bearing);
  return city;
}

double degrees_apart(Angle a, Angle b) { return std::abs(std::remainder(a.degrees() - b.degrees(), 90.0)); }
constexpr double rounding_deg = rounding_rad * 180.0 / std::numbers::pi;

/// The same city, each point moved.
CityModel moved(CityModel city, const std::function<Point2d(Point2d)>& move) {
  for (Point3d& p : city.points()) {
    const Point2d q = move(horizontal(p));
    p = {q.x, q.y, p.z};
  }
  return city;
}

/// A city with an irregular quarter: no symmetry helps.
CityModel irregular_town() {
  CityModel city = town_at(Angle::degrees(17.0));
  for (int k = 0; k < 20; ++k)
    add_extruded(city, rectangle({50.0 * k, -80.0}, Angle::degrees(17.0 + 0.37 * k * k - 3.0 * k)), 5.0 + k);
  return city;
}

TEST(StreetAlignment, FindsTheBearingOfATown) {
  for (double bearing_deg = -44.5; bearing_deg <= 45.0; bearing_deg += 0.5) {
    const Alignment found = street_alignment(town_at(Angle::degrees(bearing_deg)));
    EXPECT_LE(degrees_apart(found.bearing, Angle::degrees(bearing_deg)), rounding_deg) << bearing_deg;
    EXPECT_GT(found.bearing.degrees(), -45.0) << bearing_deg;
    EXPECT_LE(found.bearing.degrees(), 45.0) << bearing_deg;
    EXPECT_NEAR(found.strength, 1.0, 400.0 * 2.3e-16);
  }
}

TEST(StreetAlignment, TakesOneOfTheEqualBearings) {
  EXPECT_LE(degrees_apart(street_alignment(town_at(Angle::degrees(45.0))).bearing, Angle::degrees(45.0)), rounding_deg);
  EXPECT_LE(degrees_apart(street_alignment(town_at(Angle::degrees(-45.0))).bearing, Angle::degrees(45.0)), rounding_deg);
  EXPECT_LE(degrees_apart(street_alignment(town_at(Angle::degrees(120.0))).bearing, Angle::degrees(30.0)), rounding_deg);
}

TEST(StreetAlignment, NeverSaysMinusFortyFive) {
  // A hair's breadth to either side of 45° is ±π once the angle is taken fourfold
  for (const Point2d hair : {Point2d{1.1e-17, 1.0e-17}, Point2d{1.0e-17, 1.1e-17}}) {
    CityModel city;
    city.begin_building("two walls");
    for (const Point2d q : {Point2d{1.0, 1.0}, hair}) {
      city.begin_facet(SurfaceKind::wall, 0);
      city.add_ring(std::vector<Point3d>{{0, 0, 0}, {q.x, q.y, 0}, {q.x, q.y, 1}, {0, 0, 1}});
    }
    EXPECT_EQ(street_alignment(city).bearing, Angle::radians(std::numbers::pi / 4.0));
  }
}

TEST(StreetAlignment, CountsAWallAlikeHoweverItIsCut) {
  const auto mixed = [](WallCut cut) {
    CityModel city;
    add_extruded(city, rectangle({0, 0}, Angle::degrees(20.0)), 40.0, cut);
    add_extruded(city, rectangle({100, 0}, Angle::degrees(23.0)), 10.0, cut);
    return street_alignment(city);
  };
  for (const WallCut cut : {WallCut::rising_diagonal, WallCut::falling_diagonal}) {
    EXPECT_LE(degrees_apart(mixed(cut).bearing, mixed(WallCut::whole).bearing), rounding_deg);
    EXPECT_NEAR(mixed(cut).strength, mixed(WallCut::whole).strength, rounding_rad);
  }
}

TEST(StreetAlignment, DoesNotLetTowersSpeakLouder) {
  CityModel city;
  add_quarter(city, 3, Angle::degrees(10.0));
  for (const double x : {500.0, 600.0}) add_extruded(city, rectangle({x, 0}, Angle::degrees(40.0)), 300.0);
  EXPECT_LE(degrees_apart(street_alignment(city).bearing, Angle::degrees(10.0)), rounding_deg);
}

TEST(StreetAlignment, OfTwoGridsTakesTheStronger) {
  CityModel city;
  add_quarter(city, 30, Angle::degrees(-20.0));
  add_quarter(city, 70, Angle::degrees(10.0), {0.0, 200.0});
  const Alignment found = street_alignment(city);
  EXPECT_LE(degrees_apart(found.bearing, Angle::degrees(10.0)), rounding_deg) << "not the average, 2.6°";
  const double expected = std::abs(0.7 + 0.3 * std::polar(1.0, 4.0 * Angle::degrees(30.0).radians()));
  EXPECT_NEAR(found.strength, expected, rounding_rad * 4.0);
}

TEST(StreetAlignment, FindsAPeakAcrossTheEndOfTheHistogram) {
  CityModel city;
  add_quarter(city, 20, Angle::degrees(44.0));
  add_quarter(city, 20, Angle::degrees(-44.0), {0.0, 200.0});
  EXPECT_LE(degrees_apart(street_alignment(city).bearing, Angle::degrees(45.0)), rounding_deg);
}

TEST(StreetAlignment, SeesNoDirectionInACircle) {
  CityModel city;
  add_round(city, 64);
  EXPECT_NEAR(street_alignment(city).strength, 0.0, rounding_rad);
}

TEST(StreetAlignment, OfNothingIsNothing) {
  CityModel city;
  EXPECT_EQ(street_alignment(city).strength, 0.0);
  city.begin_building("flat");
  city.begin_facet(SurfaceKind::roof, 0);
  city.add_ring(std::vector<Point3d>{{0, 0, 5}, {10, 0, 5}, {10, 10, 5}, {0, 10, 5}});
  EXPECT_EQ(street_alignment(city).strength, 0.0);
  EXPECT_EQ(street_alignment(city).bearing, Angle());
}

TEST(StreetAlignment, TurnsWithTheCity) {
  const Alignment before = street_alignment(irregular_town());
  for (const double turn_deg : {7.0, 33.3, 45.0, 89.0, 123.0}) {
    const Angle turn = Angle::degrees(turn_deg);  // clockwise
    const Alignment after = street_alignment(moved(irregular_town(), [&](Point2d p) {
      return Point2d{cos(turn) * p.x + sin(turn) * p.y, -sin(turn) * p.x + cos(turn) * p.y};
    }));
    EXPECT_LE(degrees_apart(after.bearing, before.bearing + turn), 4.0 * rounding_deg) << turn_deg;
    EXPECT_NEAR(after.strength, before.strength, 4.0 * rounding_rad);
  }
}

TEST(StreetAlignment, MirrorsWithTheCity) {
  const Alignment before = street_alignment(irregular_town());
  const Alignment after = street_alignment(moved(irregular_town(), [](Point2d p) { return Point2d{-p.x, p.y}; }));
  EXPECT_LE(degrees_apart(after.bearing, -before.bearing), 4.0 * rounding_deg);
  EXPECT_NEAR(after.strength, before.strength, 4.0 * rounding_rad);
}

TEST(StreetAlignment, DoesNotDependOnScale) {
  const Alignment before = street_alignment(irregular_town());
  const Alignment after = street_alignment(moved(irregular_town(), [](Point2d p) { return 8.0 * p; }));
  EXPECT_EQ(after.bearing, before.bearing) << "a power of two changes no digit";
  EXPECT_EQ(after.strength, before.strength);
}

TEST(StreetAlignment, DoesNotDependOnOrder) {
  CityModel forwards, backwards;
  for (int k = 0; k < 30; ++k) {
    add_extruded(forwards, rectangle({50.0 * k, 0.0}, Angle::degrees(17.0 + 0.2 * k)), 10.0);
    add_extruded(backwards, rectangle({50.0 * (29 - k), 0.0}, Angle::degrees(17.0 + 0.2 * (29 - k))), 10.0);
  }
  EXPECT_LE(degrees_apart(street_alignment(forwards).bearing, street_alignment(backwards).bearing), 4.0 * rounding_deg);
}

// Bearings and convergences belong together: a street has one true azimuth, whatever map it is drawn on.

/// A town of 450 m by 150 m in Queens, in the metric CRS of Long Island.
SourceCity town_in_queens() {
  SourceCity source;
  source.source = "queens.obj";
  source.crs.definition = "EPSG:32118";
  add_quarter(source.city, 40, Angle::degrees(17.0), {315000.0, 54500.0});
  return source;
}

double true_bearing_deg(const std::string& out_crs) {
  std::vector<SourceCity> sources;
  sources.push_back(town_in_queens());
  Report report;
  const LocatedCity located = georeference::georeference(std::move(sources), {"", out_crs}, report);
  return (street_alignment(located.city).bearing + located.georeference.convergence).degrees();
}

TEST(TrueBearing, IsTheSameOnEveryMap) {
  // The convergence is that of the origin; it changes by sin φ < 1 per degree of longitude, of which the town's half spans this
  // many
  constexpr double half_a_town_deg = 225.0 / 84000.0;
  const double in_its_own_crs = true_bearing_deg("");
  for (const char* out_crs : {"EPSG:32618", "EPSG:26918", "EPSG:32619"})
    EXPECT_NEAR(true_bearing_deg(out_crs), in_its_own_crs, half_a_town_deg) << out_crs;
}

// Streets of real cities, from footprints as the surveys and OpenStreetMap drew them.

using Json = nlohmann::json;

/// Extrudes the outer ring of a GeoJSON polygon, whose last point is its first again.
void add_polygon(CityModel& city, const Json& polygon) {
  std::vector<Point2d> ring;
  for (const Json& p : polygon.at(0)) ring.push_back({p.at(0).get<double>(), p.at(1).get<double>()});
  ring.pop_back();
  if (ring.size() >= 3) add_extruded(city, ring, 10.0);
}

LocatedCity read_footprints(const std::filesystem::path& path) {
  SourceCity source;
  source.source = path.string();
  source.crs.definition = "OGC:CRS84";
  const Json file = Json::parse(std::ifstream(path));
  for (const Json& feature : file.at("features")) {
    const Json& geometry = feature.at("geometry");
    if (geometry.at("type") == "Polygon") add_polygon(source.city, geometry.at("coordinates"));
    if (geometry.at("type") == "MultiPolygon")
      for (const Json& polygon : geometry.at("coordinates")) add_polygon(source.city, polygon);
  }
  std::vector<SourceCity> sources;
  sources.push_back(std::move(source));
  Report report;
  return georeference::georeference(std::move(sources), {}, report);
}

TEST(RealStreets, ManhattanIsAtTwentyEightDegrees) {
  const auto path = scenes::test_data("manhattan/manhattan.geojson");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << scenes::absence_of(path);
  const LocatedCity located = read_footprints(path);
  EXPECT_EQ(located.georeference.epsg, 32618);
  const Alignment streets = street_alignment(located.city);
  // The Commissioners' Plan of 1811: 29° from true north, as published to the degree
  constexpr double published_to_deg = 0.5;
  EXPECT_NEAR(streets.bearing.degrees(), 28.3, published_to_deg);
  EXPECT_NEAR((streets.bearing + located.georeference.convergence).degrees(), 29.0, published_to_deg);
  RecordProperty("bearing_deg", std::to_string(streets.bearing.degrees()));
  RecordProperty("strength", std::to_string(streets.strength));
}

TEST(RealStreets, OmiyaIsWeakerThanManhattan) {
  const auto omiya = scenes::test_data("omiya/omiya.geojson"), manhattan = scenes::test_data("manhattan/manhattan.geojson");
  for (const auto& path : {omiya, manhattan})
    if (!std::filesystem::exists(path)) GTEST_SKIP() << scenes::absence_of(path);
  const LocatedCity located = read_footprints(omiya);
  EXPECT_EQ(located.georeference.epsg, 32654);
  EXPECT_LT(street_alignment(located.city).strength, street_alignment(read_footprints(manhattan).city).strength);
}

}  // namespace
}  // namespace farlod::align
