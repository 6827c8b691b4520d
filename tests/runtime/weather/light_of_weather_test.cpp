// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/light_of_weather.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using namespace std::chrono;

const PlaceOnEarth greenwich{Angle::degrees(0.0), Angle::degrees(51.5)};

Weather day_of_hours(sys_days day) {
  Weather weather;
  for (int hour = 0; hour < 24; ++hour) {
    WeatherInterval interval{day + hours(hour) + minutes(30), hours(1)};
    interval.direct_normal_w_m2 = 500.0;
    interval.diffuse_w_m2 = 100.0;
    weather.intervals.push_back(interval);
  }
  return weather;
}

double hours_of_sun(const LightInterval& interval) {
  double sum = 0.0;
  for (const SunPosition& sun : interval.sun) sum += sun.hours;
  return sum;
}

TEST(LightOfWeather, HasTheSunOfTheStepsInWhichItIsUp) {
  const LightOfWeather light = light_of(day_of_hours(sys_days(2026y / March / 20)), greenwich, minutes(5));
  ASSERT_EQ(light.intervals.size(), 24U);
  EXPECT_EQ(light.intervals[12].sun.size(), 12U);
  EXPECT_TRUE(light.intervals[2].sun.empty());
  // It rises some minutes after six
  EXPECT_GT(hours_of_sun(light.intervals[6]), 0.75);
  EXPECT_LT(hours_of_sun(light.intervals[6]), 1.0);
  // An equinox: 90° − latitude at noon, which is at 12:07; the middle of the steps of that hour is half past twelve
  EXPECT_NEAR(light.intervals[12].sun.front().elevation.degrees(), 38.5, 0.2);
  EXPECT_NEAR(light.intervals[12].sun[1].azimuth.degrees(), 180.0, 1.0);
  EXPECT_NEAR(light.intervals[12].extraterrestrial_w_m2, 1361.0 / (0.996 * 0.996), 2.0);
}

TEST(LightOfWeather, TellsOfDirectLightAtNight) {
  const LightOfWeather light = light_of(day_of_hours(sys_days(2026y / March / 20)), greenwich, minutes(5));
  EXPECT_THAT(light.remarks, testing::ElementsAre(testing::HasSubstr("5.5 kWh/m²")));
}

TEST(LightOfWeather, CountsMonthsByTheClockOfTheWeather) {
  Weather weather = day_of_hours(sys_days(2026y / January / 31));
  weather.clock_ahead_of_utc = hours(9);
  const LightOfWeather light = light_of(weather, greenwich, minutes(60));
  EXPECT_EQ(light.intervals[14].month, 1U);
  EXPECT_EQ(light.intervals[15].month, 2U);
}

TEST(LightOfWeather, DividesIntervalsIntoEqualSteps) {
  Weather weather;
  weather.intervals.push_back({sys_days(2026y / June / 21) + hours(12), minutes(50)});
  const LightOfWeather light = light_of(weather, greenwich, minutes(20));
  ASSERT_EQ(light.intervals.front().sun.size(), 3U);
  EXPECT_NEAR(light.intervals.front().sun.front().hours, 50.0 / 180.0, 1e-12);
}

}  // namespace
}  // namespace farlod
