// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/frame.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace farlod {
namespace {

constexpr double bearings_deg[] = {0.0, 20.0, 45.0, 61.3, 89.9, 90.0, -20.0, 180.0, 271.0};
/// A turn is two products and a sum, of numbers below `size`; there and back doubles it, and cos² + sin² is 1 up to as much
/// again.
constexpr double turn_error(double size) { return 8 * size * std::numeric_limits<double>::epsilon(); }

TEST(GridRotation, TheGridsYAxisHasTheBearing) {
  for (const double bearing_deg : bearings_deg) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const Angle y_axis = azimuth_of(rotation.city_from_grid(Point2d{0.0, 1.0}));
    EXPECT_NEAR(std::remainder(y_axis.degrees() - bearing_deg, 360.0), 0.0, turn_error(360.0)) << bearing_deg;
    EXPECT_EQ(rotation.bearing(), Angle::degrees(bearing_deg));
  }
}

TEST(GridRotation, IsRightHanded) {
  for (const double bearing_deg : bearings_deg) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const Point2d x = rotation.city_from_grid(Point2d{1.0, 0.0}), y = rotation.city_from_grid(Point2d{0.0, 1.0});
    EXPECT_NEAR(x.x * y.y - x.y * y.x, 1.0, turn_error(1.0));
  }
}

TEST(GridRotation, ThereAndBackIsWhereOneWas) {
  for (const double bearing_deg : bearings_deg) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const Point3d p_city{12345.678, -9876.543, 12.25};
    const Point3d back = rotation.city_from_grid(rotation.grid_from_city(p_city));
    EXPECT_NEAR(back.x, p_city.x, turn_error(norm(horizontal(p_city))));
    EXPECT_NEAR(back.y, p_city.y, turn_error(norm(horizontal(p_city))));
    EXPECT_EQ(back.z, p_city.z);
    EXPECT_EQ(horizontal(back), rotation.city_from_grid(rotation.grid_from_city(horizontal(p_city))));
  }
}

TEST(GridRotation, NoneChangesNothing) {
  const Point2d p{1.25, -7.5};
  EXPECT_EQ(GridRotation().grid_from_city(p), p);
  EXPECT_EQ(GridRotation(Angle::degrees(0)).city_from_grid(p), p);
}

TEST(Azimuth, RunsClockwiseFromNorth) {
  const struct {
    Point2d v;
    double degrees;
  } compass[] = {{{0, 1}, 0}, {{1, 1}, 45}, {{1, 0}, 90}, {{0, -1}, 180}, {{-1, 0}, 270}, {{-1, 1}, 315}};
  for (const auto& [v, degrees] : compass) EXPECT_NEAR(azimuth_of(v).degrees(), degrees, turn_error(360.0));
}

TEST(Azimuth, AHairWestOfNorthIsStillLessThanAWholeTurn) {
  for (const double hair : {1e-3, 1e-15, 1e-17, 1e-300})
    EXPECT_LT(azimuth_of({-hair, 1.0}).radians(), 2.0 * std::numbers::pi) << hair;
}

TEST(Angle, DegreesAndRadiansAreTheSameAngle) {
  EXPECT_NEAR(Angle::degrees(180.0).radians(), std::numbers::pi, std::numeric_limits<double>::epsilon() * 4);
  EXPECT_NEAR(Angle::radians(Angle::degrees(29.3).radians()).degrees(), 29.3, turn_error(29.3));
  EXPECT_LT(Angle::degrees(57.2), Angle::radians(1.0));
  EXPECT_NEAR(tan(2.0 * Angle::degrees(20) + Angle::degrees(5)), 1.0, turn_error(1.0));
}

}  // namespace
}  // namespace farlod
