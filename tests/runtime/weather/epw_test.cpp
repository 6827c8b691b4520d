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

constexpr double six_digits = 1e-2;  // that files of these tests have of W/m²

TEST(Epw, TellsThePlaceAndTheClock) {
  const Weather weather = weather_in(epw_of("2019-06").text());
  ASSERT_TRUE(weather.place.has_value());
  EXPECT_NEAR(weather.place->latitude.degrees(), 51.95, 1e-9);
  EXPECT_NEAR(weather.place->longitude.degrees(), 4.45, 1e-9);
  EXPECT_EQ(weather.place->height_m, -4.0);
  EXPECT_EQ(weather.clock_ahead_of_utc, hours(1));
  EXPECT_EQ(weather.source, "EPW of Rotterdam, NLD (weather.epw)");
  EXPECT_EQ(weather.years, WeatherYears::measured);
  EXPECT_THAT(weather.remarks, IsEmpty());
}

TEST(Epw, HoursEndAtTheirNumber) {
  const std::vector<WeatherInterval> truth = clear_hours("2019-06");
  const Weather weather = weather_in(epw_of("2019-06").text());
  ASSERT_EQ(weather.intervals.size(), 30U * 24U);
  // Hour 1 of 1 June is from 00:00 to 01:00 at UTC+1
  EXPECT_EQ(weather.intervals.front().middle_utc, sys_days{year{2019} / May / 31} + hours(23) + minutes(30));
  for (std::size_t n = 0; n < truth.size(); ++n) {
    EXPECT_EQ(weather.intervals[n].middle_utc, truth[n].middle_utc);
    EXPECT_EQ(weather.intervals[n].duration, hours(1));
    EXPECT_NEAR(weather.intervals[n].global_w_m2, truth[n].global_w_m2, six_digits);
    EXPECT_NEAR(weather.intervals[n].direct_normal_w_m2, truth[n].direct_normal_w_m2, six_digits);
    EXPECT_NEAR(weather.intervals[n].diffuse_w_m2, truth[n].diffuse_w_m2, six_digits);
  }
  EXPECT_EQ(weather.intervals[0].temperature_c, 18.5);
  EXPECT_EQ(weather.intervals[0].dew_point_c, 12.5);
  EXPECT_EQ(weather.intervals[0].pressure_hpa, 1010.0);
}

TEST(Epw, MinutesOfWholeHoursSayNothing) {
  const Weather zero = weather_in(epw_of("2019-06").text());
  for (const int minute : {60, 30}) {
    const Weather other = weather_in(epw_of("2019-06", [&](EpwRow& row) { row.minute = minute; }).text());
    EXPECT_EQ(other.intervals, zero.intervals) << minute;
    EXPECT_THAT(other.remarks, IsEmpty());
  }
}

TEST(Epw, QuartersOfHoursCountFrom0OrTo60) {
  const std::vector<WeatherInterval> truth = clear_hours("2019-06-21", 60, 15);
  for (const int first : {0, 15}) {
    EpwFile file;
    file.periods = "DATA PERIODS,1,4,Data,Sunday,6/21,6/21";
    for (std::size_t n = 0; n < truth.size(); ++n) {
      EpwRow row = epw_row_of(truth[n]);
      row.minute = first + 15 * static_cast<int>(n % 4);
      file.rows.push_back(row.text());
    }
    const Weather weather = weather_in(file.text());
    ASSERT_EQ(weather.intervals.size(), 96U);
    for (std::size_t n = 0; n < truth.size(); ++n) EXPECT_EQ(weather.intervals[n].middle_utc, truth[n].middle_utc) << first;
    EXPECT_EQ(weather.intervals[0].duration, minutes(15));
    EXPECT_THAT(weather.remarks, ElementsAre(HasSubstr("4 rows an hour")));
  }
}

TEST(Epw, ALeapYearHas8784Hours) {
  EpwFile file = epw_of("2020");
  file.periods = "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31";
  const Weather weather = weather_in(file.text());
  EXPECT_EQ(weather.intervals.size(), 8784U);
  EXPECT_EQ(weather.years, WeatherYears::measured);
  EXPECT_THAT(weather.remarks, IsEmpty());
}

TEST(Epw, MonthsOfDifferentYearsAreTypical) {
  EpwFile file = epw_of("2019", [](EpwRow& row) { row.year = row.month % 2 == 0 ? 1999 : 2004; });
  const Weather weather = weather_in(file.text());
  EXPECT_EQ(weather.intervals.size(), 8760U);
  EXPECT_EQ(weather.years, WeatherYears::typical);
  EXPECT_THAT(weather.remarks, IsEmpty());
  // A month that is missing is a gap of the year
  std::erase_if(file.rows, [](const std::string& row) { return row.starts_with("2004,3,"); });
  EXPECT_THAT(weather_in(file.text()).remarks, ElementsAre(HasSubstr("no rows for 744 h: from 03-01 00:00 to 04-01 00:00")));
  // As is its end
  file.rows.resize(1000);
  EXPECT_THAT(weather_in(file.text()).remarks, ElementsAre(HasSubstr("It ends early")));
}

TEST(Epw, KnowsTheIlluminanceThatCanBeTrue) {
  const auto with_lux = [](double direct_lux_in_watt, double diffuse_lux_in_watt) {
    return weather_in(epw_of("2019-06",
                             [&](EpwRow& row) {
                               row.direct_lux = direct_lux_in_watt * row.direct;
                               row.diffuse_lux = diffuse_lux_in_watt * row.diffuse;
                             })
                          .text())
        .intervals;
  };
  for (const WeatherInterval& hour : with_lux(95.0, 120.0)) {
    ASSERT_TRUE(hour.direct_normal_lux && hour.diffuse_lux);
    EXPECT_NEAR(*hour.direct_normal_lux, 95.0 * hour.direct_normal_w_m2, 100.0 * six_digits);
    EXPECT_NEAR(*hour.diffuse_lux, 120.0 * hour.diffuse_w_m2, 200.0 * six_digits);
  }
  // Hundreds of lux, none by day, and the code of nothing known
  const auto knows_noon = [](const std::vector<WeatherInterval>& hours) { return hours[12].diffuse_lux.has_value(); };
  EXPECT_TRUE(knows_noon(with_lux(95.0, 120.0)));
  EXPECT_FALSE(knows_noon(with_lux(9500.0, 12000.0)));
  EXPECT_FALSE(knows_noon(with_lux(0.0, 0.0)));
  EXPECT_FALSE(knows_noon(
      weather_in(epw_of("2019-06", [](EpwRow& row) { row.direct_lux = row.diffuse_lux = 999999.0; }).text()).intervals));
}

TEST(Epw, RowsWithoutIrradianceAreLeftOut) {
  for (const double code : {9999.0, 99999.0, -999.0, -9999.0}) {
    std::size_t count = 0;
    const EpwFile file = epw_of("2019-06", [&](EpwRow& row) {
      if (row.day == 3 && row.hour <= 12) row.global = row.direct = row.diffuse = (++count, code);
    });
    const Weather weather = weather_in(file.text());
    EXPECT_EQ(weather.intervals.size(), 708U);
    EXPECT_THAT(weather.remarks, ElementsAre("12 of 720 rows of weather.epw have no irradiance, the first in line " +
                                             std::to_string(EpwFile::line_of(48)) + ": sums are of the others alone."));
  }
  EXPECT_THAT(complaint_about(epw_of("2019-06", [](EpwRow& row) { row.global = row.diffuse = 9999; }).text()),
              HasSubstr("weather.epw: no row has irradiance"));
}

TEST(Epw, OneOfThreeIsFoundFromTheOthers) {
  const Weather truth = weather_in(epw_of("2019-06-21").text());
  const auto lacking = [](double EpwRow::*member) {
    return weather_in(epw_of("2019-06-21", [&](EpwRow& row) { row.*member = 9999; }).text());
  };
  // The sun's mean over an hour differs from its middle by .3 % when it is high; in the hours of sunrise and sunset it is theirs
  constexpr double sum_error = 0.01;
  const Weather direct = lacking(&EpwRow::direct), diffuse = lacking(&EpwRow::diffuse), global = lacking(&EpwRow::global);
  EXPECT_THAT(direct.remarks.at(1),
              HasSubstr("rows direct irradiance is missing, and found from global and diffuse (first in line "));
  EXPECT_THAT(diffuse.remarks.at(1), HasSubstr("rows diffuse irradiance is missing, and found from global and direct"));
  EXPECT_THAT(global.remarks.at(1), HasSubstr("rows global irradiance is missing, and found from direct and diffuse"));
  EXPECT_NEAR(global_sum(global), global_sum(truth), sum_error * global_sum(truth));
  for (const std::size_t hour : {8U, 12U, 16U}) {
    EXPECT_NEAR(direct.intervals[hour].direct_normal_w_m2, truth.intervals[hour].direct_normal_w_m2, 9.0);
    EXPECT_NEAR(diffuse.intervals[hour].diffuse_w_m2, truth.intervals[hour].diffuse_w_m2, 9.0);
  }
  // Parts make up the whole
  for (const WeatherInterval& hour : direct.intervals) EXPECT_GE(hour.global_w_m2, hour.diffuse_w_m2);
}

TEST(Epw, GapsAreToldWithTheirPlace) {
  EpwFile file = epw_of("2019-06");
  file.rows.erase(file.rows.begin() + 100, file.rows.begin() + 110);
  file.rows.erase(file.rows.begin() + 200);
  EXPECT_THAT(weather_in(file.text()).remarks,
              ElementsAre("weather.epw has no rows for 11 h: from 2019-06-05 04:00 to 2019-06-05 14:00 (line " +
                          std::to_string(EpwFile::line_of(99)) + "), the first of 2 gaps. Sums are of the others alone."));
  EXPECT_EQ(weather_in(file.text()).intervals.size(), 709U);
}

TEST(Epw, ThatEndsBeforeItSaysIsTold) {
  EpwFile file = epw_of("2019-06");
  file.rows.resize(480);
  EXPECT_THAT(weather_in(file.text()).remarks,
              ElementsAre(AllOf(HasSubstr("240 h: from 2019-06-21 00:00 to 2019-07-01 00:00"), HasSubstr("It ends early"))));
}

TEST(Epw, SmallNegativeIrradiancesAreNothing) {
  const Weather weather = weather_in(epw_of("2019-06", [](EpwRow& row) {
                                       if (row.hour == 1) row.global = -3.5;
                                     }).text());
  EXPECT_EQ(weather.intervals[0].global_w_m2, 0.0);
  EXPECT_THAT(weather.remarks, ElementsAre("30 irradiances are a little below 0, the first in line 9: 0 is taken."));
}

TEST(Epw, WhatCannotBeIsRefusedWithItsLine) {
  const auto with = [](double EpwRow::*member, double value) {
    return complaint_about(epw_of("2019-06", [&](EpwRow& row) {
                             if (row.day == 2 && row.hour == 13) row.*member = value;
                           }).text());
  };
  EXPECT_EQ(
      with(&EpwRow::direct, 1450),
      "weather.epw:45: a direct normal irradiance of 1450 W/m² cannot be; correct it, or write -999 where nothing is known");
  EXPECT_THAT(with(&EpwRow::global, 2100), HasSubstr("weather.epw:45: a global irradiance of 2100"));
  EXPECT_THAT(with(&EpwRow::diffuse, -50), HasSubstr("weather.epw:45: a diffuse irradiance of -50"));
}

TEST(Epw, RowsThatAreNoneAreRefusedWithTheirLine) {
  const auto with_row = [](const std::string& row) {
    EpwFile file = epw_of("2019-06");
    file.rows[7] = row;
    return complaint_about(file.text());
  };
  const EpwRow good{2019, 6, 1, 8, 0, 100, 100, 50};
  EXPECT_EQ(with_row(good.text()), "no refusal");
  EXPECT_THAT(with_row(EpwRow{2019, 6, 1, 0}.text()), HasSubstr("weather.epw:16: the hour is 0; EPW counts hours from 1 to 24"));
  EXPECT_THAT(with_row(EpwRow{2019, 6, 1, 25}.text()), HasSubstr("the hour is 25"));
  EXPECT_THAT(with_row(EpwRow{2019, 6, 31, 8}.text()), HasSubstr("weather.epw:16: there is no 2019-06-31"));
  EXPECT_THAT(with_row(EpwRow{19, 6, 1, 8}.text()), HasSubstr("before 1961"));
  EXPECT_THAT(with_row(EpwRow{2019, 6, 1, 8, 61}.text()), HasSubstr("the minute is 61"));
  EXPECT_THAT(with_row(EpwRow{2019, 6, 1, 7}.text()),
              HasSubstr("weather.epw:16: the row of 2019-06-01 06:00 begins before that of line 15 has ended; sort the rows"));
  EXPECT_THAT(with_row("2019,6,1,8,0,?,18.5"),
              HasSubstr("weather.epw:16: the row ends after 7 of 32 fields: the file was cut off"));
  EXPECT_THAT(with_row("2019,6,1,eight" + good.text().substr(10)), HasSubstr("\"eight\" is not a number (hour)"));
}

TEST(Epw, HeadersThatAreNoneAreRefused) {
  EpwFile file = epw_of("2019-06-21");
  file.latitude = "151.95";
  EXPECT_THAT(complaint_about(file.text()), HasSubstr("weather.epw:1: latitude 151.95, longitude 4.45 is no place"));
  file.latitude = "51.95";
  file.zone = "60";
  EXPECT_THAT(complaint_about(file.text()), HasSubstr("weather.epw:1: the time zone 60 is none"));
  file.zone = "1";
  file.periods = "DATA PERIODS,1,0,Data,Sunday,6/1,6/30";
  EXPECT_THAT(complaint_about(file.text()), HasSubstr("weather.epw:8: there cannot be 0 records an hour"));
  file.periods = "DATA PERIODS,1,7,Data,Sunday,6/1,6/30";
  EXPECT_THAT(complaint_about(file.text()), HasSubstr("weather.epw:8: there cannot be 7 records an hour"));
  file.periods = "DATA PERIODS,1,2,Data,Sunday,6/1,6/30";
  file.rows[3] = EpwRow{2019, 6, 21, 4, 20}.text();
  EXPECT_THAT(complaint_about(file.text()), HasSubstr("weather.epw:12: the minute is 20, where the file has 2 rows an hour"));
  EXPECT_THAT(complaint_about("LOCATION,Rotterdam\n"), HasSubstr("weather.epw:1: the row ends before latitude"));
  file.rows.clear();
  EXPECT_THAT(complaint_about(file.text()), HasSubstr("weather.epw: the file ends before its first hour: it was cut off"));
}

TEST(Epw, RadiationAtNightIsRefused) {
  EpwFile file = epw_of("2019-06");
  file.zone = "-8";
  EXPECT_THAT(complaint_about(file.text()),
              AllOf(HasSubstr("of the irradiance falls at night at 51.95° N, 4.45° E, first"), HasSubstr("(UTC−8)"),
                    HasSubstr("the time zone or the place is wrong; times 9 h earlier would fit; correct them")));
  // Hours that are off by one are of the same day: the parts tell them
  file.zone = "2";
  EXPECT_THAT(weather_in(file.text()).remarks.front(),
              AllOf(HasSubstr("Global irradiance differs from direct and diffuse"), HasSubstr("were its times 60 min later")));
}

TEST(Epw, ALittleRadiationAtNightIsTold) {
  const EpwFile file = epw_of("2019-06", [](EpwRow& row) {
    if (row.day == 5 && row.hour == 1) row.global = row.diffuse = 30;
  });
  EXPECT_THAT(weather_in(file.text()).remarks, ElementsAre(AllOf(HasSubstr("% of the irradiance falls at night"),
                                                                 HasSubstr("first 30 W/m² around 2019-06-05 00:30 (UTC+1)"))));
}

TEST(Epw, PartsThatDoNotFitTogetherAreTold) {
  EpwFile shifted;
  for (const WeatherInterval& hour : clear_hours("2019-06-01T00:30/30T23:30")) {
    EpwRow row = epw_row_of(hour);
    shifted.rows.push_back(row.text());
  }
  EXPECT_THAT(weather_in(shifted.text()).remarks.back(), HasSubstr("were its times 30 min later"));
  const EpwFile level = epw_of("2019-06", [](EpwRow& row) { row.direct = row.global - row.diffuse; });
  EXPECT_THAT(weather_in(level.text()).remarks, ElementsAre(HasSubstr("direct seems to be that of a level plane")));
  const EpwFile wrong = epw_of("2019-06", [](EpwRow& row) { row.diffuse *= 3.0; });
  EXPECT_THAT(weather_in(wrong.text()).remarks, ElementsAre(HasSubstr("the place may be another, or one of the three wrong")));
}

TEST(Epw, OfPvgisHasInstantsInTheRowsOfTheHoursBefore) {
  // In the file of 45° N, 8° E and UTC+1 that pvlib tests with, the row of 1 January, hour 13, has the sun of 12:10 UTC
  const std::vector<WeatherInterval> instants = clear_hours("2019-06-01T00:30/30T23:30");
  EpwFile file;
  file.name = "unknown,-,unknown,ECMWF/ERA";
  for (const WeatherInterval& instant : instants) {
    EpwRow row = epw_row_of(instant);
    if (row.hour == 24) continue;
    file.rows.push_back(row.text());
  }
  const Weather weather = weather_in(file.text());
  EXPECT_EQ(weather.intervals.front().middle_utc, sys_days{year{2019} / June / 1});
  EXPECT_THAT(weather.remarks, testing::Contains(HasSubstr("is an EPW of PVGIS: its rows are taken for instants")));
  EXPECT_THAT(weather.remarks, testing::Not(testing::Contains(HasSubstr("were its times"))));
}

TEST(Epw, APlaceFarFromTheCityIsTold) {
  const std::string text = epw_of("2019-06-21").text();
  const auto gap = HasSubstr("has no rows");
  EXPECT_THAT(weather_in(text, place_at(51.0, 6.0)).remarks, ElementsAre(gap));
  EXPECT_THAT(weather_in(text, place_at(49.5, 4.45)).remarks,
              ElementsAre(gap, "The weather is that of 51.95° N, 4.45° E, 272 km from the city at 49.50° N, 4.45° E."));
  // The sun is that of the weather
  EXPECT_NEAR(weather_in(text, place_at(-33.9, 151.2)).place->latitude.degrees(), 51.95, 1e-9);
}

TEST(WeatherFile, ThatIsNoneIsRefused) {
  EXPECT_THAT(complaint_about(""), HasSubstr("weather.epw: the file is empty; give an EPW"));
  EXPECT_THAT(complaint_about(" \n\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(complaint_about(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)),
              HasSubstr("the file is no weather, it is no text"));
  EXPECT_THAT(complaint_about("{\"type\": \"FeatureCollection\"}"), HasSubstr("the file is no weather, it is JSON"));
  EXPECT_THAT(complaint_about("<!DOCTYPE html>"), HasSubstr("it is a web page or XML"));
  EXPECT_THAT(complaint_about("PK\x03\x04zip"), HasSubstr("it is a ZIP archive: unpack it first"));
  EXPECT_THAT(complaint_about("\x1F\x8Bgz"), HasSubstr("it is packed by gzip"));
  EXPECT_THAT(complaint_about("id,x,y\n1,2,3\n"), HasSubstr("weather.epw:1: the file is no weather: no column is a time"));
  EXPECT_THAT(scenes::refusal_of<InputError>([] { (void)read_weather("/nowhere/a.epw", std::nullopt); }),
              HasSubstr("/nowhere/a.epw does not exist"));
  const scenes::TemporaryFolder folder;
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_weather(folder.path(), std::nullopt); }),
              HasSubstr("is a folder: give a file"));
}

}  // namespace
}  // namespace farlod
