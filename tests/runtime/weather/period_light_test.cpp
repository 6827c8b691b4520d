// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <limits>

#include "farlod/weather.hpp"
#include "tests/runtime/weather/weather_files.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;

std::string what_is_wrong(const LightSource& source, const PlaceOnEarth& place = rotterdam) {
  return scenes::refusal_of<InvalidArgument>([&] { (void)light_of_period(source, place); });
}

TEST(PeriodLight, OfAFileHasItsHoursAndItsSum) {
  const scenes::TemporaryFolder folder;
  const std::string text = epw_of("2026-06").text();
  const PeriodLight light = light_of_period({.weather_file = folder.write("weather.epw", text)}, rotterdam);
  EXPECT_EQ(light.intervals.size(), 30U * 24U);
  EXPECT_DOUBLE_EQ(light.hours, 30.0 * 24.0);
  EXPECT_THAT(light.source, HasSubstr("weather.epw"));
  // Direct, with the sun of each hour, and diffuse make up the global irradiance of the file
  const double of_file = global_sum(weather_in(text));
  EXPECT_NEAR(light.global_horizontal_kwh_m2, of_file, 0.01 * of_file);
  EXPECT_GT(of_file, 150.0);
}

TEST(PeriodLight, OfAPeriodIsAPartOfTheFile) {
  const scenes::TemporaryFolder folder;
  const LightSource source{.weather_file = folder.write("weather.epw", epw_of("2026-06").text()),
                           .period = "06-21T10:00/16:00",
                           .step = std::chrono::minutes(20)};
  const PeriodLight light = light_of_period(source, rotterdam);
  EXPECT_DOUBLE_EQ(light.hours, 6.0);
  ASSERT_EQ(light.intervals.size(), 6U);
  EXPECT_EQ(light.intervals.front().sun.size(), 3U);
}

TEST(PeriodLight, OfAClearSkyNeedsNoFile) {
  const PeriodLight light = light_of_period({.period = "2026-06-21"}, rotterdam);
  EXPECT_DOUBLE_EQ(light.hours, 24.0);
  EXPECT_EQ(light.intervals.size(), 24U * 12U);
  // A clear day in June at 52° north has 8 to 9 kWh/m²
  EXPECT_GT(light.global_horizontal_kwh_m2, 8.0);
  EXPECT_LT(light.global_horizontal_kwh_m2, 9.0);
  const PeriodLight hazy = light_of_period({.period = "2026-06-21", .linke_turbidity = 6.0}, rotterdam);
  EXPECT_LT(hazy.global_horizontal_kwh_m2, light.global_horizontal_kwh_m2);
}

TEST(PeriodLight, OfANightIsThatOfTheSkyAlone) {
  const PeriodLight light = light_of_period({.period = "2026-12-21T00:00Z/03:00Z"}, rotterdam);
  EXPECT_DOUBLE_EQ(light.hours, 3.0);
  EXPECT_EQ(light.global_horizontal_kwh_m2, 0.0);
}

TEST(PeriodLight, TellsOfAFileOfAnotherPlace) {
  const scenes::TemporaryFolder folder;
  const LightSource source{.weather_file = folder.write("weather.epw", epw_of("2026-06").text())};
  const PeriodLight here = light_of_period(source, rotterdam), elsewhere = light_of_period(source, place_at(35.9, 139.6));
  EXPECT_TRUE(here.remarks.empty());
  EXPECT_THAT(elsewhere.remarks, testing::Contains(HasSubstr("km")));
  EXPECT_EQ(elsewhere.global_horizontal_kwh_m2, here.global_horizontal_kwh_m2) << "the sun is that of the file's place";
}

TEST(PeriodLight, RefusesWhatItsDeclarationsDoNotAllow) {
  EXPECT_THAT(what_is_wrong({}), HasSubstr("weather"));
  EXPECT_THAT(what_is_wrong({.period = "someday"}), HasSubstr("someday"));
  EXPECT_THAT(what_is_wrong({.period = "06-21"}), HasSubstr("06-21"));
  for (const int minutes : {0, -5, 61})
    EXPECT_THAT(what_is_wrong({.period = "2026", .step = std::chrono::minutes(minutes)}), HasSubstr("1 to 60")) << minutes;
  EXPECT_NE(what_is_wrong({.period = "2026-06-21", .linke_turbidity = 0.5}), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double latitude : {91.0, -90.5, nan})
    EXPECT_THAT(what_is_wrong({.period = "2026-06-21"}, place_at(latitude, 4.45)), HasSubstr("latitude")) << latitude;
  EXPECT_THAT(what_is_wrong({.period = "2026-06-21"}, place_at(52.0, nan)), HasSubstr("longitude"));
  EXPECT_THROW((void)light_of_period({.weather_file = "no_such.epw"}, rotterdam), InputError);
}

}  // namespace
}  // namespace farlod
