// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "sun/sun_positions.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "farlod/error.hpp"

namespace farlod {
namespace {

using namespace std::chrono;

double hours_of(const std::vector<SunPosition>& positions) {
  return std::accumulate(positions.begin(), positions.end(), 0.0, [](double sum, const SunPosition& p) { return sum + p.hours; });
}

PlaceOnEarth place(double longitude_deg, double latitude_deg, double height_m = 0.0) {
  return {Angle::degrees(longitude_deg), Angle::degrees(latitude_deg), height_m};
}

TEST(SunDirection, IsThatOfTheExampleOfNrel) {
  // I. Reda and A. Andreas, Solar Position Algorithm for Solar Radiation Applications, NREL/TP-560-34302, Table A5.1
  const auto time = sys_days{year{2003} / October / 17} + hours(19) + minutes(30) + seconds(30);
  const SunDirection sun = sun_direction(place(-105.1786, 39.742476, 1830.14), time, {820.0, 11.0});
  EXPECT_NEAR(90.0 - sun.elevation.degrees(), 50.11162, 0.002);
  EXPECT_NEAR(sun.azimuth.degrees(), 194.34024, 0.002);
}

TEST(SunDirection, IsUnknownBefore1960) {
  EXPECT_THROW((void)sun_direction(place(0, 50), sys_days{year{1900} / January / 1}), InvalidArgument);
}

TEST(SunDirections, AreThoseOfSingleTimes) {
  // The axis is that of noon (.2″), all else is a thousandth of that; at sunrise, refraction halves what elevations differ by,
  // and an azimuth near the zenith is off by more
  constexpr double axis_deg = 0.0002;
  const PlaceOnEarth somewhere = place(139.6, 35.9, 20.0);
  std::vector<sys_time<milliseconds>> times;
  for (int n = 0; n < 400; ++n) times.push_back(sys_days{year{2016} / December / 20} + n * minutes(1337) + milliseconds(7));
  times.push_back(times.front());
  times.push_back(sys_days{year{2016} / December / 31} + hours(24) - milliseconds(1));  // in the leap second's day
  const std::vector<SunDirection> many = sun_directions(somewhere, times, {990.0, 20.0});
  ASSERT_EQ(many.size(), times.size());
  for (std::size_t n = 0; n < times.size(); ++n) {
    const SunDirection one = sun_direction(somewhere, times[n], {990.0, 20.0});
    EXPECT_NEAR(many[n].elevation.degrees(), one.elevation.degrees(), axis_deg) << n;
    EXPECT_NEAR(many[n].azimuth.degrees(), one.azimuth.degrees(), axis_deg / cos(one.elevation)) << n;
  }
  EXPECT_TRUE(sun_directions(somewhere, {}).empty());
  EXPECT_THROW((void)sun_directions(somewhere, std::vector<sys_time<milliseconds>>{sys_days{year{1900} / January / 1}}),
               InvalidArgument);
}

TEST(SunPositions, OfAnEquinoxLastHalfADay) {
  // Refraction and nothing else makes the day longer at the equator: by some 5 minutes, as the sun rises upright by 15° an hour
  const auto positions = sun_positions(place(10, 0), sys_days{year{2026} / March / 20}, 1, minutes(1));
  EXPECT_NEAR(hours_of(positions), 12.0 + 2.0 * 0.57 / 15.0, 0.03);
  EXPECT_LT(positions.front().azimuth.degrees(), 91.0);
  EXPECT_GT(positions.front().azimuth.degrees(), 89.0);
  EXPECT_NEAR(positions[positions.size() / 2].elevation.degrees(), 90.0, 1.0);
}

TEST(SunPositions, OfPolarDaysLastAllDayAndOfPolarNightsNone) {
  EXPECT_NEAR(hours_of(sun_positions(place(25, 75), sys_days{year{2026} / June / 21}, 1, minutes(10))), 24.0, 1e-9);
  EXPECT_TRUE(sun_positions(place(25, 75), sys_days{year{2026} / December / 21}, 1, minutes(10)).empty());
}

TEST(SunPositions, OfAYearAreHalfOfIt) {
  // And more by refraction, and as the northern summer is longer
  EXPECT_NEAR(hours_of(sun_positions(place(139.6, 35.9), sys_days{year{2026} / January / 1}, 365, minutes(10))), 365.0 * 12.0,
              60.0);
}

TEST(SunPositions, SplitStepsThatDoNotFit) {
  EXPECT_NEAR(hours_of(sun_positions(place(25, 75), sys_days{year{2026} / June / 21}, 1, minutes(7))), 24.0, 1e-9);
}

TEST(SunCourse, IsWhereTheSunIsEachMinuteOfLocalMeanTime) {
  // The Earth's axis is that of the day's beginning: it moves by a second of arc
  constexpr double axis_moves_deg = 0.0005;
  const PlaceOnEarth munich = place(11.5, 48.1);
  const auto course = sun_course(munich, sys_days{year{2026} / June / 21});
  ASSERT_EQ(course.size(), 24U * 60U + 1U);
  EXPECT_EQ(local_mean_time_ahead(munich.longitude), minutes(46));
  for (const int minute : {0, 300, 720, 1440}) {
    const SunDirection sun = sun_direction(munich, sys_days{year{2026} / June / 21} + minutes(minute - 46));
    EXPECT_NEAR(course[static_cast<std::size_t>(minute)].elevation.degrees(), sun.elevation.degrees(), axis_moves_deg);
    EXPECT_NEAR(course[static_cast<std::size_t>(minute)].azimuth.degrees(), sun.azimuth.degrees(), axis_moves_deg);
  }
  // At noon it stands highest, in the south, but for the equation of time (2 minutes) and what an almanac says of its declination
  EXPECT_NEAR(course[720].elevation.degrees(), 90.0 - 48.1 + 23.44, 0.05);
}

}  // namespace
}  // namespace farlod
