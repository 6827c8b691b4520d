// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/runtime/weather/weather_files.hpp"

namespace farlod {
namespace {

using namespace std::chrono;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Hours from the first of January of a year, each with its number as irradiance.
Weather hours_of(int first_year, std::size_t count) {
  Weather weather;
  weather.source = "made up";
  weather.clock_ahead_of_utc = hours(1);
  for (std::size_t n = 0; n < count; ++n) {
    WeatherInterval hour;
    hour.middle_utc = sys_days{year{first_year} / January / 1} - hours(1) + hours(n) + minutes(30);
    hour.duration = hours(1);
    hour.global_w_m2 = static_cast<double>(n);
    weather.intervals.push_back(hour);
  }
  return weather;
}

/// The same, where months with an even number are of 1996, and the others of 1985.
Weather typical_hours() {
  Weather weather = hours_of(2019, 8760);
  weather.years = WeatherYears::typical;
  for (WeatherInterval& hour : weather.intervals) {
    const auto clock = hour.middle_utc + hours(1);
    const year_month_day day(floor<days>(clock));
    const year then{static_cast<unsigned>(day.month()) % 2 == 0 ? 1996 : 1985};
    hour.middle_utc = sys_days{then / day.month() / day.day()} + (clock - floor<days>(clock)) - hours(1);
  }
  return weather;
}

milliseconds length_of(const Weather& weather) {
  milliseconds length{};
  for (const WeatherInterval& interval : weather.intervals) length += interval.duration;
  return length;
}

std::string complaint(const Weather& weather, const char* period) {
  return scenes::refusal_of<InputError>([&] { (void)within(weather, period_in(period)); });
}

TEST(Within, HoldsTheHoursOfThePeriod) {
  const Weather year = hours_of(2019, 8760);
  const Weather day = within(year, period_in("2019-01-02"));
  ASSERT_EQ(day.intervals.size(), 24U);
  EXPECT_EQ(day.intervals.front(), year.intervals[24]);
  EXPECT_EQ(day.intervals.back(), year.intervals[47]);
  EXPECT_THAT(day.remarks, IsEmpty());
  EXPECT_EQ(length_of(within(year, period_in("2019-02"))), hours(28 * 24));
  EXPECT_EQ(length_of(within(year, period_in("2019"))), hours(8760));
  const Weather morning = within(year, period_in("2019-01-02T10:00/12:00"));
  EXPECT_THAT(morning.intervals, ElementsAre(year.intervals[34], year.intervals[35]));
}

TEST(Within, CutsIntervalsAtItsBorders) {
  const Weather part = within(hours_of(2019, 100), period_in("2019-01-01T10:15/12:30"));
  ASSERT_EQ(part.intervals.size(), 3U);
  const auto clock = [](int hour, int minute) { return sys_days{year{2019} / January / 1} + hours(hour - 1) + minutes(minute); };
  EXPECT_EQ(part.intervals[0].duration, minutes(45));
  EXPECT_EQ(part.intervals[0].middle_utc, clock(10, 37) + seconds(30));
  EXPECT_EQ(part.intervals[0].global_w_m2, 10.0);
  EXPECT_EQ(part.intervals[1].middle_utc, clock(11, 30));
  EXPECT_EQ(part.intervals[2].duration, minutes(30));
  EXPECT_EQ(part.intervals[2].middle_utc, clock(12, 15));
  const Weather minute = within(hours_of(2019, 100), period_in("2019-01-01T10:15"));
  ASSERT_EQ(minute.intervals.size(), 1U);
  EXPECT_EQ(minute.intervals[0].middle_utc, clock(10, 15) + seconds(30));
}

TEST(Within, ReadsTheClockThatIsWritten) {
  const Weather year = hours_of(2019, 8760);
  EXPECT_THAT(within(year, period_in("2019-01-02T10:00Z/11:00Z")).intervals, ElementsAre(year.intervals[35]));
  EXPECT_THAT(within(year, period_in("2019-01-02T10:00+01:00/11:00")).intervals, ElementsAre(year.intervals[34]));
  EXPECT_EQ(within(year, period_in("2019-01-02T10:00Z/11:00Z")).clock_ahead_of_utc, minutes(0));
}

TEST(Within, TellsWhatTheWeatherLacks) {
  Weather weather = hours_of(2019, 8760);
  weather.intervals.erase(weather.intervals.begin() + 30, weather.intervals.begin() + 33);
  EXPECT_THAT(
      within(weather, period_in("2019-01")).remarks,
      ElementsAre(
          "Of the 744 h of 2019-01, the weather lacks 3 h, the first at 2019-01-02 06:00: sums are of the others alone."));
  EXPECT_THAT(within(weather, period_in("2019-12/2020-01")).remarks,
              ElementsAre(HasSubstr("lacks 744 h, the first at 2020-01-01 00:00")));
  EXPECT_THAT(within(weather, period_in("2018-12/2019-01")).remarks,
              ElementsAre(HasSubstr("lacks 747 h, the first at 2018-12-01 00:00")));
}

TEST(Within, AYearThatWasNotMeasuredIsRefused) {
  EXPECT_THAT(complaint(hours_of(2019, 8760), "2026-06"),
              AllOf(HasSubstr("the weather (made up) has nothing of 2026-06: it is that of 2019-01-01 00:00 to 2020-01-01 00:00"),
                    HasSubstr("choose a period of it, or leave out the year")));
  EXPECT_THAT(complaint(hours_of(2019, 8760), "02-29"), HasSubstr("has nothing of 02-29"));
  EXPECT_THAT(complaint(Weather{}, "2026"), HasSubstr("is empty"));
}

TEST(Within, AnyYearIsTheOneThatWasMeasured) {
  const Weather year = hours_of(2019, 8760);
  EXPECT_EQ(within(year, period_in("06")).intervals, within(year, period_in("2019-06")).intervals);
  EXPECT_EQ(within(year, period_in("06-21T10:00/16:00")).intervals, within(year, period_in("2019-06-21T10:00/16:00")).intervals);
  EXPECT_EQ(within(year, period_in("01")).intervals, within(year, period_in("2019-01")).intervals);
  EXPECT_EQ(length_of(within(year, period_in("02"))), hours(28 * 24));
  EXPECT_THAT(within(year, period_in("02")).remarks, IsEmpty());
  EXPECT_THAT(complaint(hours_of(2019, 20000), "06"), HasSubstr("\"06\" of more than one year; write which, such as 2019-06"));
}

TEST(Within, TypicalWeatherIsThatOfEachYear) {
  const Weather typical = typical_hours();
  for (const char* june : {"2026-06", "06", "1985-06"}) {
    const Weather weather = within(typical, period_in(june));
    ASSERT_EQ(weather.intervals.size(), 720U) << june;
    EXPECT_EQ(weather.intervals.front(), typical.intervals[151 * 24]) << june;
    EXPECT_THAT(weather.remarks, IsEmpty()) << june;
  }
  EXPECT_EQ(within(typical, period_in("2026")).intervals, typical.intervals);
  EXPECT_EQ(length_of(within(typical, period_in("02"))), hours(28 * 24));
  EXPECT_THAT(within(typical, period_in("02")).remarks, IsEmpty());
}

TEST(Within, ALackOfTypicalWeatherHasNoYear) {
  Weather typical = typical_hours();
  typical.intervals.erase(typical.intervals.begin() + 1);
  EXPECT_THAT(within(typical, period_in("01")).remarks, ElementsAre(HasSubstr("lacks 1 h, the first at 01-01 01:00: sums")));
  EXPECT_THAT(within(typical, period_in("2026-01")).remarks,
              ElementsAre(HasSubstr("lacks 1 h, the first at 2026-01-01 01:00: sums")));
}

TEST(Within, AWinterOfTypicalWeatherIsInItsOrder) {
  const Weather typical = typical_hours();
  for (const char* winter : {"2025-11/2026-02", "11/02"}) {
    const Weather weather = within(typical, period_in(winter));
    ASSERT_EQ(weather.intervals.size(), (30U + 31U + 31U + 28U) * 24U) << winter;
    EXPECT_EQ(weather.intervals.front(), typical.intervals[304 * 24]) << winter;
    EXPECT_EQ(weather.intervals.back(), typical.intervals[59 * 24 - 1]) << winter;
    EXPECT_THAT(weather.remarks, IsEmpty()) << winter;
  }
}

TEST(Within, TypicalWeatherHasNoLeapDayAndOneYear) {
  EXPECT_THAT(within(typical_hours(), period_in("2028")).remarks,
              ElementsAre(HasSubstr("lacks 24 h, the first at 2028-02-29 00:00")));
  EXPECT_THAT(complaint(typical_hours(), "2025/2026"), HasSubstr("one typical year, and 2025/2026 is longer"));
}

TEST(Within, IntervalsAcrossANewYearAreCutOnce) {
  // Instants at 30 minutes after each hour of UTC, on a clock that is 17 minutes ahead
  Weather weather = typical_hours();
  weather.clock_ahead_of_utc = minutes(17);
  EXPECT_EQ(length_of(within(weather, period_in("2026"))), hours(8760));
  EXPECT_THAT(within(weather, period_in("2026")).remarks, IsEmpty());
}

TEST(MonthOf, IsThatOfTheClock) {
  const Weather weather = hours_of(2019, 1000);
  EXPECT_EQ(month_of(weather, weather.intervals[0]), January);  // in December of UTC
  EXPECT_EQ(month_of(weather, weather.intervals[744]), February);
}

TEST(ClearSkyWeather, HasStepsUpToTheEndOfThePeriod) {
  Period period = period_in("2026-06-21T10:00+02:00/11:15");
  const Weather weather = clear_sky_weather(rotterdam, period, minutes(30), 3.0);
  ASSERT_EQ(weather.intervals.size(), 3U);
  EXPECT_EQ(weather.intervals[0].middle_utc, sys_days{year{2026} / June / 21} + hours(8) + minutes(15));
  EXPECT_EQ(weather.intervals[2].middle_utc, sys_days{year{2026} / June / 21} + hours(9) + minutes(7) + seconds(30));
  EXPECT_EQ(weather.intervals[2].duration, minutes(15));
  EXPECT_EQ(weather.clock_ahead_of_utc, hours(2));
  EXPECT_EQ(weather.source, "the clear sky of Ineichen and Perez 2002, Linke turbidity 3");
}

TEST(ClearSkyWeather, IsThatOfTheSunsElevation) {
  for (const WeatherInterval& interval : clear_hours("2026-06-21")) {
    const double sine = std::max(0.0, sin(sun_direction(rotterdam, interval.middle_utc).elevation));
    EXPECT_NEAR(interval.global_w_m2, interval.direct_normal_w_m2 * sine + interval.diffuse_w_m2, 0.05);
    EXPECT_EQ(interval.global_w_m2 > 0.0, sine > 0.0);
  }
  // At noon of the solstice, the sun is 61.5° high: air mass 1.137, extraterrestrial 1,318 W/m². The formula by hand: .868 · 1318
  // · .879 · exp(−.0387 · 1.137 · 3) = 881 W/m²
  const Weather noon = clear_sky_weather(rotterdam, period_in("2026-06-21T11:44Z/11:45Z"), minutes(1), 3.0);
  EXPECT_NEAR(noon.intervals.front().global_w_m2, 881.0, 1.0);
  // The step changes the sum of a day by less than half a percent
  const double fine = global_sum(clear_sky_weather(rotterdam, period_in("2026-03-20"), minutes(5), 3.0));
  EXPECT_NEAR(global_sum(clear_sky_weather(rotterdam, period_in("2026-03-20"), minutes(30), 3.0)), fine, 0.005 * fine);
}

TEST(ClearSkyWeather, RefusesWhatCannotBe) {
  const auto refused = [](const char* period, minutes step, double turbidity) {
    return scenes::refusal_of<InvalidArgument>([&] { (void)clear_sky_weather(rotterdam, period_in(period), step, turbidity); });
  };
  EXPECT_THAT(refused("06-21", minutes(10), 3), HasSubstr("\"06-21\" has no year, which the clear sky needs"));
  EXPECT_THAT(refused("2026-06-21", minutes(0), 3), HasSubstr("less than a second; give minutes"));
  EXPECT_THAT(refused("2026-06-21", minutes(10), 0.5), HasSubstr("a Linke turbidity of 0.5 cannot be"));
  EXPECT_THAT(refused("2026-06-21", minutes(10), 13), HasSubstr("a Linke turbidity of 13 cannot be"));
}

}  // namespace
}  // namespace farlod
