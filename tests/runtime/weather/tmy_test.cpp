// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <iomanip>

#include "tests/runtime/weather/weather_files.hpp"

namespace farlod {
namespace {

using namespace std::chrono;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The TMY of PVGIS of Rotterdam, with months of two years, whose satellite passes so many minutes after each hour.
std::string pvgis_tmy(int minutes_after_hour, const std::string& offset_line, bool with_header = true) {
  std::ostringstream text;
  if (with_header)
    text << "Latitude (decimal degrees): 51.950\r\nLongitude (decimal degrees): 4.450\r\nElevation (m): -4.0\r\n"
         << offset_line << "month,year\r\n1,2009\r\n2,2012\r\n12,2010\r\n";
  text << "time(UTC),T2m,RH,G(h),Gb(n),Gd(h),IR(h),WS10m,WD10m,SP\r\n" << std::fixed << std::setprecision(2);
  Period period = period_in("2019");
  period.clock_ahead_of_utc = minutes(30 - minutes_after_hour);
  const Weather truth = clear_sky_weather(rotterdam, period, hours(1), 3.0);
  for (const WeatherInterval& hour : truth.intervals) {
    const auto stamp = hour.middle_utc - minutes(minutes_after_hour);
    const year_month_day day(floor<days>(stamp));
    const bool even = static_cast<unsigned>(day.month()) % 2 == 0;
    text << (even ? 2012 : 2009) << std::setfill('0') << std::setw(2) << static_cast<unsigned>(day.month()) << std::setw(2)
         << static_cast<unsigned>(day.day()) << ':' << std::setw(2) << floor<hours>(stamp - floor<days>(stamp)).count()
         << "00,10.5,50," << hour.global_w_m2 << ',' << hour.direct_normal_w_m2 << ',' << hour.diffuse_w_m2
         << ",250.0,1.5,100.0,98000.0\r\n";
  }
  text << "\r\nT2m: 2-m air temperature (degree Celsius)\r\n\r\nPVGIS (c) European Union, 2001-2026\r\n";
  return text.str();
}

const std::string pvgis_offset = "Irradiance Time Offset (h): 0.1667\r\n";

TEST(PvgisTmy, IsOfTheInstantAtItsOffset) {
  const Weather weather = weather_in(pvgis_tmy(10, pvgis_offset));
  ASSERT_EQ(weather.intervals.size(), 8760U);
  EXPECT_EQ(weather.years, WeatherYears::typical);
  EXPECT_EQ(weather.source, "TMY of PVGIS (weather.epw)");
  EXPECT_EQ(floor<seconds>(weather.intervals[0].middle_utc), sys_days{year{2009} / January / 1} + minutes(10));
  EXPECT_EQ(weather.intervals[0].duration, hours(1));
  EXPECT_EQ(weather.intervals[0].temperature_c, 10.5);
  EXPECT_EQ(weather.intervals[0].pressure_hpa, 980.0);
  EXPECT_NEAR(weather.intervals[0].dew_point_c, 0.5, 0.1);  // air of 10.5 °C that is half full
  // 4.45° E is nearest to UTC, and all fits the sun of 2019 as well as that of 2009 and 2012
  EXPECT_EQ(weather.clock_ahead_of_utc, hours(0));
  EXPECT_THAT(weather.remarks, IsEmpty());
}

TEST(PvgisTmy, WithoutItsOffsetIsComparedWithTheSun) {
  EXPECT_THAT(weather_in(pvgis_tmy(0, "")).remarks, ElementsAre(HasSubstr("has no \"Irradiance Time Offset\"")));
  EXPECT_THAT(weather_in(pvgis_tmy(30, "")).remarks,
              ElementsAre(HasSubstr("has no \"Irradiance Time Offset\""), HasSubstr("were its times 30 min later")));
}

TEST(PvgisTmy, WithoutItsHeaderIsOfTheCity) {
  const Weather weather = weather_in(pvgis_tmy(0, "", false));
  EXPECT_EQ(weather.place->latitude, rotterdam.latitude);
  EXPECT_EQ(weather.intervals.size(), 8760U);
  EXPECT_THAT(weather_in(pvgis_tmy(0, "", false), std::nullopt).remarks.back(), HasSubstr("were not compared with the sun"));
}

TEST(PvgisTmy, ThatWasCutOffIsTold) {
  std::string text = pvgis_tmy(10, pvgis_offset);
  const std::size_t july = text.find("20090701:0000");
  EXPECT_THAT(weather_in(text.substr(0, july)).remarks,
              ElementsAre(AllOf(HasSubstr("no rows for 4416 h: from 07-01 00:00 to 01-01 00:00"), HasSubstr("It ends early"))));
  EXPECT_THAT(complaint_about(text.substr(0, july + 20)), HasSubstr("of 10 fields: the file was cut off"));
  EXPECT_THAT(complaint_about(text.substr(0, text.find("20090101"))), HasSubstr("no rows below its header: it was cut off"));
}

TEST(PvgisTmy, WhatWasChangedIsRefused) {
  std::string text = pvgis_tmy(10, pvgis_offset);
  std::string renamed = text, stamped = text;
  EXPECT_THAT(complaint_about(renamed.replace(renamed.find("Gb(n)"), 5, "beam")), HasSubstr("there is no column Gb(n)"));
  EXPECT_THAT(complaint_about(stamped.replace(stamped.find("20090101:0000"), 13, "2009-01-01 00")),
              HasSubstr("\"2009-01-01 00\" is no time of PVGIS, such as 20090131:2300"));
}

/// A TMY3 of Rotterdam.
std::string tmy3() {
  std::ostringstream text;
  text << "725300,\"ROTTERDAM, \"\"THE HAGUE\"\" AP\",NL,1.0,51.95,4.45,-4\n"
       << "Date (MM/DD/YYYY),Time (HH:MM),ETR (W/m^2),GHI (W/m^2),GHI source,DNI (W/m^2),DHI (W/m^2),Dry-bulb (C),Dew-point "
          "(C),RHum "
          "(%),Pressure (mbar)\n";
  for (const WeatherInterval& hour : clear_hours("2019")) {
    const EpwRow row = epw_row_of(hour);
    text << std::setfill('0') << std::setw(2) << row.month << '/' << std::setw(2) << row.day << '/'
         << (row.month == 2 ? 1996 : 1988) << ',' << std::setw(2) << row.hour << ":00,500," << row.global << ",1," << row.direct
         << ',' << row.diffuse << ",7.5,-1.5,50,1001\n";
  }
  return text.str();
}

TEST(Tmy3, EndsItsHoursAtTheirTimes) {
  const Weather weather = weather_in(tmy3());
  ASSERT_EQ(weather.intervals.size(), 8760U);
  EXPECT_EQ(weather.years, WeatherYears::typical);
  EXPECT_EQ(weather.source, "TMY3 of ROTTERDAM, \"THE HAGUE\" AP, NL (weather.epw)");
  EXPECT_EQ(weather.clock_ahead_of_utc, hours(1));
  EXPECT_EQ(weather.intervals[0].middle_utc, sys_days{year{1987} / December / 31} + hours(23) + minutes(30));
  EXPECT_EQ(weather.intervals[0].dew_point_c, -1.5);
  EXPECT_EQ(weather.intervals[0].pressure_hpa, 1001.0);
  EXPECT_NEAR(weather.place->latitude.degrees(), 51.95, 1e-9);
  EXPECT_THAT(weather.remarks, IsEmpty());
}

TEST(Tmy3, WhatWasChangedIsRefused) {
  std::string hour = tmy3(), date = hour;
  EXPECT_THAT(complaint_about(hour.replace(hour.find(",01:00,"), 7, ",00:00,")),
              HasSubstr("weather.epw:3: the time is 00:00; TMY3 counts"));
  EXPECT_THAT(complaint_about(date.replace(date.find("01/01/1988"), 10, "1988-01-01")),
              HasSubstr("\"1988-01-01,01:00\" is no time of TMY3, such as 01/31/1988,24:00"));
}

}  // namespace
}  // namespace farlod
