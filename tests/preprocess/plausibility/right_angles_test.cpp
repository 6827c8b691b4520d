// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/right_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace farlod::plausibility {
namespace {

/// Degrees of longitude and latitude along a metre.
Point2d degrees_of_metre_at(double latitude_deg) {
  return {1.0 / (metres_in_a_degree * std::cos(latitude_deg * std::numbers::pi / 180.0)), 1.0 / metres_in_a_degree};
}

struct DrawnTown {
  Point2d lon_lat_deg;
  double turned_deg = 29.0;
  Point2d degrees_of_metre = degrees_of_metre_at(lon_lat_deg.y);
  bool is_exchanged = false;
  int houses = 20;
};

/// Roofs of 12 m by 9 m in a row, to seven digits.
CityModel model_of(const DrawnTown& town) {
  const double turned = town.turned_deg * std::numbers::pi / 180.0;
  const auto place = [&](double along_m, double across_m) {
    const double east_m = along_m * std::cos(turned) - across_m * std::sin(turned),
                 north_m = along_m * std::sin(turned) + across_m * std::cos(turned);
    const double lon = std::round(1e7 * (town.lon_lat_deg.x + east_m * town.degrees_of_metre.x)) / 1e7,
                 lat = std::round(1e7 * (town.lon_lat_deg.y + north_m * town.degrees_of_metre.y)) / 1e7;
    return town.is_exchanged ? Point3d{lat, lon, 5.0} : Point3d{lon, lat, 5.0};
  };
  CityModel city;
  for (int n = 0; n < town.houses; ++n) {
    const double x = 20.0 * n;
    city.begin_building(std::to_string(n));
    city.begin_facet(SurfaceKind::unknown, 0);
    city.add_ring(std::vector<Point3d>{place(x, 0.0), place(x + 12.0, 0.0), place(x + 12.0, 9.0), place(x, 9.0)});
  }
  return city;
}

bool is_told(DrawnTown town, bool is_exchanged) {
  town.is_exchanged = is_exchanged;
  return right_angles_of(model_of(town)).speak_for_exchange();
}

TEST(RightAngles, TellLatitudesThatWereTakenForLongitudes) {
  for (const Point2d lon_lat_deg : {Point2d{4.47, 51.92}, {8.54, 47.37}, {-73.97, 40.75}, {24.94, 60.17}, {-58.4, -34.6}}) {
    EXPECT_TRUE(is_told({lon_lat_deg}, true)) << lon_lat_deg.x << ' ' << lon_lat_deg.y;
    EXPECT_FALSE(is_told({lon_lat_deg}, false)) << lon_lat_deg.x << ' ' << lon_lat_deg.y;
  }
}

TEST(RightAngles, AreCounted) {
  const RightAngles found = right_angles_of(model_of({.lon_lat_deg = {4.47, 51.92}, .is_exchanged = true}));
  EXPECT_EQ(found.corners, 80U);
  EXPECT_EQ(found.exchanged, 80U);
  EXPECT_EQ(found.as_read, 0U);
  EXPECT_EQ(found.in_degrees, 0U);
}

TEST(RightAngles, TellNothingWhereBothOrdersHaveThem) {
  EXPECT_FALSE(is_told({.lon_lat_deg = {4.47, 51.92}, .turned_deg = 0.0}, true)) << "along the meridians";
  EXPECT_FALSE(is_told({.lon_lat_deg = {3.39, 6.45}}, true)) << "near the equator, where degrees are alike";
  EXPECT_FALSE(is_told({.lon_lat_deg = {4.47, 51.92}, .houses = 19}, true)) << "few houses";
  EXPECT_FALSE(is_told({.lon_lat_deg = {139.76, 35.68}}, false)) << "a longitude that is no latitude";
}

TEST(RightAngles, OfATownThatWasDrawnInDegreesTellNothing) {
  const Point2d alike{1.0 / metres_in_a_degree, 1.0 / metres_in_a_degree};
  EXPECT_FALSE(is_told({.lon_lat_deg = {4.47, 51.92}, .degrees_of_metre = alike}, false));
}

TEST(RightAngles, OfWallsAreNone) {
  CityModel city;
  city.begin_building("wall");
  city.begin_facet(SurfaceKind::unknown, 0);
  city.add_ring(std::vector<Point3d>{{8.0, 50.0, 0.0}, {8.001, 50.0, 0.0}, {8.001, 50.0, 9.0}, {8.0, 50.0, 9.0}});
  EXPECT_EQ(right_angles_of(city).corners, 0U);
}

}  // namespace
}  // namespace farlod::plausibility
