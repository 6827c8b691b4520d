// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/plan_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/frame.hpp"

namespace farlod {
namespace {

/// Sine and cosine here and in the mathematics library are each good to a few units in the last place of 1; a coordinate is
/// the sum of two products with them, and the angle itself is rounded when it is made of degrees (at most 2π here).
constexpr double rotation_error(double length_m) { return 16.0 * std::numeric_limits<double>::epsilon() * length_m; }

TEST(PlanRotation, TurnsAsTheGridOfThePackageDoes) {
  const Point2d p{300.0, -120.0};
  for (double bearing_deg = -360.0; bearing_deg <= 360.0; bearing_deg += 7.25) {
    const Point2d here = PlanRotation(bearing_deg).city_from_plan(p);
    const Point2d there = GridRotation(Angle::degrees(bearing_deg)).city_from_grid(p);
    EXPECT_LE(norm(here - there), rotation_error(norm(p))) << bearing_deg;
  }
}

TEST(PlanRotation, HasItsInverse) {
  const Point2d p{123.45, 678.9};
  for (double bearing_deg = -90.0; bearing_deg <= 90.0; bearing_deg += 3.3) {
    const PlanRotation rotation(bearing_deg);
    EXPECT_LE(norm(rotation.plan_from_city(rotation.city_from_plan(p)) - p), rotation_error(norm(p)));
  }
}

TEST(PlanRotation, QuartersAreExact) {
  const Point2d p{12.34, 56.78};
  EXPECT_EQ(PlanRotation(0.0).city_from_plan(p), p);
  EXPECT_EQ(PlanRotation(90.0).city_from_plan(p), (Point2d{56.78, -12.34}));
  EXPECT_EQ(PlanRotation(180.0).city_from_plan(p), (Point2d{-12.34, -56.78}));
  EXPECT_EQ(PlanRotation(-90.0).city_from_plan(p), PlanRotation(270.0).city_from_plan(p));
}

TEST(LotFrame, RunsCounterClockwiseAroundTheBlock) {
  for (int side = 0; side < 4; ++side) {
    const LotFrame lot{{10.0, 20.0}, side};
    const Point2d corner = lot.plan_from_lot({0, 0});
    const Point2d u = lot.plan_from_lot({1, 0}) - corner, v = lot.plan_from_lot({0, 1}) - corner;
    EXPECT_EQ(corner, lot.corner);
    EXPECT_EQ(u.x * v.y - u.y * v.x, 1.0) << side;
    const Point2d outwards[] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    EXPECT_EQ(-1.0 * v, outwards[side]) << side;
  }
}

TEST(Millimetres, RoundToTheNearest) {
  EXPECT_EQ(millimetres(1.2344), 1234);
  EXPECT_EQ(millimetres(-1.2346), -1235);
  EXPECT_EQ(on_plan_grid_m(1.236), 1.24);
}

}  // namespace
}  // namespace farlod
