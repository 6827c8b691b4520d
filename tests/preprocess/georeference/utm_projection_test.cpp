// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/utm_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "georeference/crs.hpp"

namespace farlod::georeference {
namespace {

constexpr Ellipsoid wgs84{6378137.0, 298.257223563};
/// The figures are stated to a thousandth of a degree.
constexpr double last_digit_deg = 0.0005;
/// Two series, each good to 5 nm (Karney 2011), from degrees whose last bit is 3 nm: PROJ and GeographicLib may differ by this.
constexpr double two_series_m = 2.0 * (5e-9 + 3e-9);

TEST(UtmZone, FollowsTheExceptionsOfTheNorth) {
  EXPECT_EQ(utm_zone_of({-73.97, 40.78}), (UtmZone{18, true}));
  EXPECT_EQ(utm_zone_of({5.32, 60.39}), (UtmZone{32, true})) << "Bergen";
  EXPECT_EQ(utm_zone_of({15.6, 78.2}), (UtmZone{33, true})) << "Longyearbyen";
  EXPECT_EQ(utm_zone_of({151.2, -33.9}), (UtmZone{56, false}));
  EXPECT_EQ(utm_zone_of({179.9, 0.0}), (UtmZone{60, true}));
  EXPECT_EQ(utm_zone_of({-100.0, 86.0}), (UtmZone{14, true})) << "beyond UTM proper";
}

TEST(UtmProjection, PutsTheMeridianAtHalfAMillion) {
  EXPECT_EQ(UtmProjection({31, true}, wgs84).projected({3.0, 0.0}), (Point2d{500000.0, 0.0}));
  EXPECT_EQ(UtmProjection({31, false}, wgs84).projected({3.0, 0.0}), (Point2d{500000.0, 1e7}));
}

TEST(UtmProjection, AgreesWithProj) {
  const auto wgs84_crs = Crs::find("EPSG:4326"), utm = Crs::find("EPSG:32618");
  ASSERT_TRUE(wgs84_crs && utm);
  for (const Point2d place : {Point2d{-73.97, 40.78}, Point2d{-77.9, 5.0}, Point2d{-72.1, 79.0}}) {
    const auto ours = UtmProjection({18, true}, wgs84).projected(place);
    const auto theirs = CrsTransformation(*wgs84_crs, *utm, place).apply(place);
    ASSERT_TRUE(ours && theirs);
    EXPECT_NEAR(ours->x, theirs->x, two_series_m);
    EXPECT_NEAR(ours->y, theirs->y, two_series_m);
  }
}

TEST(UtmProjection, HasAnInverse) {
  const UtmProjection utm({33, false}, wgs84);
  const Point2d place{17.25, -22.5};
  const Point2d back = utm.lon_lat_deg(*utm.projected(place));
  constexpr double two_series_deg = two_series_m / 1e5;  // a degree is longer than 100 km here
  EXPECT_NEAR(back.x, place.x, two_series_deg);
  EXPECT_NEAR(back.y, place.y, two_series_deg);
}

TEST(UtmProjection, HasNoPlaceForWhatIsFarOff) {
  const UtmProjection utm({32, true}, wgs84);
  EXPECT_FALSE(utm.projected({0.0, 0.0})) << "9 degrees from the meridian, at the equator";
  EXPECT_FALSE(utm.projected({189.0, 50.0})) << "on the other side of the Earth";
  EXPECT_FALSE(utm.projected({9.0, 95.0}));
  EXPECT_FALSE(utm.projected({std::numeric_limits<double>::quiet_NaN(), 50.0}));
  EXPECT_FALSE(utm.projected({std::numeric_limits<double>::infinity(), 50.0}));
}

TEST(Convergence, IsWhatIsKnownOfManhattanAndBarcelona) {
  const UtmProjection zone_18({18, true}, wgs84), zone_31({31, true}, wgs84);
  EXPECT_NEAR(zone_18.convergence_at(*zone_18.projected({-73.97, 40.78})).degrees(), 0.673, last_digit_deg);
  EXPECT_NEAR(zone_31.convergence_at(*zone_31.projected({2.16, 41.39})).degrees(), -0.555, last_digit_deg);
}

// The promise itself: true azimuth = grid azimuth + γ, measured on two points one above the other
TEST(Convergence, TurnsGridAzimuthsIntoTrueOnes) {
  for (const Point2d place : {Point2d{-73.97, 40.78}, Point2d{-76.5, -33.0}}) {
    const UtmProjection utm(utm_zone_of(place), wgs84);
    const Point2d p = *utm.projected(place);
    constexpr double step_deg = 1e-4;
    const Point2d to_true_north = *utm.projected(place + Point2d{0.0, step_deg}) - p;
    const double grid_azimuth = std::atan2(to_true_north.x, to_true_north.y);
    // Rounding of two coordinates over 11 m, and the bend of the meridian, less than a step's worth of latitude
    const double measured_rad = 4.0 * two_series_m / 11.0 + step_deg * (3.14159265358979 / 180.0);
    EXPECT_NEAR(grid_azimuth + utm.convergence_at(p).radians(), 0.0, measured_rad);
  }
}

}  // namespace
}  // namespace farlod::georeference
