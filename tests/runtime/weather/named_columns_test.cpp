// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <iomanip>

#include "tests/runtime/weather/weather_files.hpp"
#include "weather/clock_text.hpp"

namespace farlod {
namespace {

using namespace std::chrono;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two days in June, in a table whose times lie so many minutes after the beginnings of its hours.
std::string two_days(const std::string& header, int minutes_after_begin, char separator = ',', const char* clock = "Z") {
  std::ostringstream text;
  text << header << '\n';
  for (const WeatherInterval& hour : clear_hours("2019-06-20/21", 0)) {
    const auto time = hour.middle_utc - minutes(30) + minutes(minutes_after_begin);
    const year_month_day day(floor<days>(time));
    const auto of_day = floor<minutes>(time - floor<days>(time)).count();
    text << "2019-06-" << std::setfill('0') << std::setw(2) << static_cast<unsigned>(day.day()) << 'T' << std::setw(2)
         << of_day / 60 << ':' << std::setw(2) << of_day % 60 << clock << separator << hour.global_w_m2 << separator
         << hour.direct_normal_w_m2 << separator << hour.diffuse_w_m2 << '\n';
  }
  return text.str();
}

const std::string taken_for_usual = "48 of 48 rows have no dew point or humidity: 60 % is taken.";

TEST(WeatherColumns, TimeIsTheBeginningAndEndAndMiddleAreTheirs) {
  const std::vector<WeatherInterval> truth = clear_hours("2019-06-20/21", 0);
  const std::array<std::pair<std::string, int>, 3> meanings{{{"time", 0}, {"middle", 30}, {"end", 60}}};
  for (const auto& [name, after_begin] : meanings) {
    const Weather weather = weather_in(two_days(name + ",global,direct,diffuse", after_begin));
    ASSERT_EQ(weather.intervals.size(), truth.size()) << name;
    for (std::size_t n = 0; n < truth.size(); ++n) EXPECT_EQ(weather.intervals[n].middle_utc, truth[n].middle_utc) << name;
    const std::string meaning = name == "time" ? "beginning" : name;
    EXPECT_THAT(weather.remarks, ElementsAre("The times of weather.epw are taken for the " + meaning + " of intervals of 1 h.",
                                             "48 of 48 rows have no temperature: 15 °C is taken.", taken_for_usual));
  }
}

TEST(WeatherColumns, LastUntilTheNextRow) {
  const Weather weather = weather_in(
      "time,global,direct,diffuse\n2019-06-20T00:00Z,0,0,0\n2019-06-20T00:10Z,0,0,0\n2019-06-20T00:30Z,0,0,0\n2019-06-20T00:40Z,"
      "0,0,0\n");
  EXPECT_EQ(weather.intervals.back().duration, minutes(10));
  EXPECT_EQ(weather.intervals.back().middle_utc, sys_days{year{2019} / June / 20} + minutes(45));
  EXPECT_THAT(weather.remarks[0], HasSubstr("intervals of 10 min."));
  EXPECT_THAT(weather.remarks[1], HasSubstr("no rows for 10 min: from 2019-06-20 00:20 to 2019-06-20 00:30 (line 3). Sums"));
}

TEST(WeatherColumns, WrongMeaningsAreTold) {
  EXPECT_THAT(weather_in(two_days("time,global,direct,diffuse", 60)).remarks.back(), HasSubstr("were its times 60 min earlier"));
}

TEST(WeatherColumns, HaveManyNamesAndSeparators) {
  const Weather plain = weather_in(two_days("time,global,direct,diffuse", 0));
  EXPECT_EQ(weather_in(two_days("Time;GHI [W/m2];DNI [W/m2];DHI (W/m²)", 0, ';')).intervals, plain.intervals);
  EXPECT_EQ(weather_in(two_days("\xEF\xBB\xBF"
                                "begin\tGlobal Horizontal\tDirect_Normal\tdiffuse_w_m2",
                                0, '\t'))
                .intervals,
            plain.intervals);
  EXPECT_EQ(weather_in(two_days("# measured on the roof\ntime_utc,ghi,dni,dhi", 0, ',', "")).intervals, plain.intervals);
  EXPECT_EQ(weather_in(two_days("time (UTC),ghi,dni,dhi", 0, ',', ":00.000")).intervals, plain.intervals);
}

TEST(WeatherColumns, ClocksAreTheirs) {
  const Weather weather = weather_in(two_days("time,global,direct,diffuse", 60, ',', "+01:00"));
  EXPECT_EQ(weather.intervals, weather_in(two_days("time,global,direct,diffuse", 0)).intervals);
  EXPECT_EQ(weather.clock_ahead_of_utc, hours(1));
  // In the night of the 27th, clocks go back: 02:00 is twice
  const std::string autumn =
      "time,global,direct,diffuse\n2019-10-27T01:00+02:00,0,0,0\n2019-10-27T02:00+02:00,0,0,0\n2019-10-27T02:00+01:00,0,0,0\n"
      "2019-10-27T03:00+01:00,0,0,0\n";
  EXPECT_EQ(weather_in(autumn).intervals.back().middle_utc, sys_days{year{2019} / October / 27} + hours(2) + minutes(30));
}

TEST(WeatherColumns, UtcIsReadAtTheClockOfTheLongitude) {
  const std::string text = two_days("time,global,direct,diffuse", 0);
  EXPECT_THAT(complaint_about(text, place_at(35.9, 139.6)), HasSubstr("falls at night at 35.90° N, 139.60° E"));
  const std::string dark = "time,global,direct,diffuse\n2019-06-20T12:00Z,0,0,0\n2019-06-20T13:00Z,0,0,0\n";
  const Weather weather = weather_in(dark, place_at(35.9, 139.6));
  EXPECT_EQ(weather.clock_ahead_of_utc, hours(9));
  EXPECT_THAT(weather.remarks.back(),
              HasSubstr("Times of the file are UTC; days, months and times of a period are those of UTC+9"));
}

TEST(WeatherColumns, GlobalAloneIsSplitAfterErbs) {
  const Weather weather = weather_in(two_days("time,global,beam,sky", 0));
  EXPECT_THAT(weather.remarks[1],
              HasSubstr("global irradiance stands alone: it is split into direct and diffuse after Erbs et al. 1982"));
  const WeatherInterval& noon = weather.intervals[11];
  // Clear at noon: a clearness of .75, of which Erbs makes 17 % diffuse
  EXPECT_NEAR(noon.diffuse_w_m2 / noon.global_w_m2, 0.17, 0.02);
  for (const WeatherInterval& hour : weather.intervals) {
    EXPECT_LE(hour.direct_normal_w_m2, 1330.0);
    EXPECT_GE(hour.diffuse_w_m2, 0.0);
    EXPECT_LE(hour.diffuse_w_m2, hour.global_w_m2);
  }
}

TEST(WeatherColumns, DirectIrradianceOfALowSunIsNoMoreThanThatOfTheSun) {
  // The sun sets at 20:04 UTC, 4 minutes after the second hour began
  const Weather weather = weather_in("time,global,diffuse\n2019-06-20T19:00Z,200,20\n2019-06-20T20:00Z,10,5\n");
  const WeatherInterval& low = weather.intervals[0];
  EXPECT_NEAR(low.direct_normal_w_m2, 1361.0 / (1.0162 * 1.0162), 1.0);
  EXPECT_GT(low.diffuse_w_m2, 100.0);
  EXPECT_LT(low.diffuse_w_m2, 200.0);
  EXPECT_EQ(weather.intervals[1].direct_normal_w_m2, 0.0);
  EXPECT_EQ(weather.intervals[1].diffuse_w_m2, 10.0);
}

TEST(WeatherColumns, ThatNeedTheSunNeedAPlace) {
  EXPECT_THAT(complaint_about(two_days("time,global,beam,sky", 0), std::nullopt),
              HasSubstr("the irradiances need the sun to be completed, and the place is not known"));
  EXPECT_THAT(weather_in(two_days("time,global,direct,diffuse", 0), std::nullopt).remarks,
              testing::Contains(HasSubstr("its times were not compared with the sun")));
}

TEST(WeatherColumns, EmptyFieldsAreNotKnown) {
  const Weather weather = weather_in(
      "time,global,direct,diffuse,temp_air,rh,pressure\n2019-06-20T12:00Z,500,,200,20,50,101300\n2019-06-20T13:00Z,NaN,NaN,NaN,,,"
      "\n"
      "2019-06-20T14:00Z,500,400,200,-999,999,\n");
  ASSERT_EQ(weather.intervals.size(), 2U);
  EXPECT_GT(weather.intervals[0].direct_normal_w_m2, 300.0);
  EXPECT_EQ(weather.intervals[0].pressure_hpa, 1013.0);
  EXPECT_NEAR(weather.intervals[0].dew_point_c, 9.3, 0.1);
  EXPECT_EQ(weather.intervals[1].temperature_c, 15.0);
}

TEST(WeatherColumns, ThatDoNotTellAreRefused) {
  const std::string row = "\n2019-06-20T12:00Z,1,2,3\n";
  EXPECT_THAT(complaint_about("hour,global,direct,diffuse" + row),
              HasSubstr("weather.epw:1: the file is no weather: no column is a time"));
  EXPECT_THAT(
      complaint_about("time,wind,direct,rain" + row),
      HasSubstr("weather.epw:1: the columns do not tell the irradiance: there is neither global, nor direct and diffuse"));
  EXPECT_THAT(complaint_about("time,global,ghi,diffuse" + row), HasSubstr("\"global\" and \"ghi\" mean the same"));
  EXPECT_THAT(complaint_about("time,global,direct,diffuse" + row),
              HasSubstr("a table of one row does not tell how long it lasted"));
  EXPECT_THAT(complaint_about("time,global\n"), HasSubstr("a table of one row"));
}

TEST(WeatherColumns, TimesThatAreNoneAreRefused) {
  const auto with_times = [](const std::string& first, const std::string& second) {
    return complaint_about("time,global,direct,diffuse\n" + first + ",0,0,0\n" + second + ",0,0,0\n");
  };
  EXPECT_EQ(with_times("2019-06-20 12:00Z", "2019-06-20 13:00Z"), "no refusal");
  EXPECT_THAT(with_times("2019-06-20 12:00", "2019-06-20 13:00"),
              HasSubstr("weather.epw:2: \"2019-06-20 12:00\" is a time of an unknown clock; write Z or an offset"));
  EXPECT_THAT(with_times("20.06.2019 12:00", ""), HasSubstr("\"20.06.2019 12:00\" is no time; write it like 2026-06-21T10:00Z"));
  EXPECT_THAT(with_times("2019-06-20", "2019-06-21"), HasSubstr("is no time"));
  EXPECT_THAT(with_times("2019-06-20T00:00Z", "2019-06-21T00:00Z"),
              HasSubstr("the rows are 24 h apart, in which the sun goes too far"));
  EXPECT_THAT(with_times("2019-06-20T01:00Z", "2019-06-20T00:00Z"), HasSubstr("the times of the rows do not rise; sort them"));
}

TEST(ClockText, IsWhatItSays) {
  const auto full = clock_text_in("2026-06-21T10:00:30.25+09:30");
  ASSERT_TRUE(full.has_value());
  EXPECT_THAT(full->date, ElementsAre(2026, 6, 21));
  EXPECT_EQ(full->time_of_day, hours(10) + milliseconds(30250));
  EXPECT_EQ(full->ahead_of_utc, minutes(570));
  EXPECT_EQ(clock_text_in("10:00")->time_of_day, hours(10));
  for (const char* wrong :
       {"", "2026-", "2026-06-21T", "2026-06-21T10", "2026-06-21T10:00+", "2026-06-21T10:00+9", "2026-06-21T10:00ZZ",
        "2026-06-21T24:01", "2026-06-21X10:00", "2026-06-21-01", "2026-06-21T10:00.", "202-06"})
    EXPECT_EQ(clock_text_in(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace farlod
