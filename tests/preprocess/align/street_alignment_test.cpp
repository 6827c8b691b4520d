// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "align/street_alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <functional>

#include "tests/preprocess/align/extruded_town.hpp"

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

}  // namespace
}  // namespace farlod::align
