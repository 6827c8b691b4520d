// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "weather/weather.hpp"

namespace farlod {

inline PlaceOnEarth place_at(double latitude_deg, double longitude_deg) {
  return {Angle::degrees(longitude_deg), Angle::degrees(latitude_deg)};
}

inline const PlaceOnEarth rotterdam = place_at(51.95, 4.45);

/// Hours of a clear sky in Rotterdam, on a clock of so many minutes ahead of UTC.
inline std::vector<WeatherInterval> clear_hours(const std::string& period_text, int minutes_ahead = 60, int minutes = 60) {
  Period period = period_in(period_text);
  period.clock_ahead_of_utc = std::chrono::minutes(minutes_ahead);
  return clear_sky_weather(rotterdam, period, std::chrono::minutes(minutes), 3.0).intervals;
}

/// An EPW of Rotterdam, in text that a test may change.
struct EpwFile {
  std::string name = "Rotterdam,ZH,NLD,Made up", latitude = "51.95", longitude = "4.45", zone = "1.0";
  std::string periods = "DATA PERIODS,1,1,Data,Sunday,6/1,6/30";
  std::vector<std::string> rows;

  /// Line of a row, as messages count it.
  static std::size_t line_of(std::size_t row) { return row + 9; }
  [[nodiscard]] std::string text() const {
    std::string all =
        "LOCATION," + name + ",063440," + latitude + "," + longitude + "," + zone + ",-4.0\n" +
        "DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n" +
        "COMMENTS 1,one \"quote\nCOMMENTS 2\n" + periods + "\n";
    for (const std::string& row : rows) all += row + "\n";
    return all;
  }
};

/// A row of a file: when its interval ends, on the clock of the file, and what fell in it.
struct EpwRow {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double global = 0.0, direct = 0.0, diffuse = 0.0;
  double direct_lux = 0.0, diffuse_lux = 0.0;

  [[nodiscard]] std::string text() const {
    std::ostringstream row;
    row << year << ',' << month << ',' << day << ',' << hour << ',' << minute << ",?9?9?9,18.5,12.5,68,101000,0,0,300," << global
        << ',' << direct << ',' << diffuse << ",0," << direct_lux << ',' << diffuse_lux
        << ",0,270,3.5,5,5,20,77777,9,999999999,0,.1,0,88";
    return row.str();
  }
};

inline EpwRow epw_row_of(const WeatherInterval& hour, int minutes_ahead = 60) {
  const auto begin = hour.middle_utc + std::chrono::minutes(minutes_ahead) - hour.duration / 2;
  const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(begin));
  const auto of_day = std::chrono::floor<std::chrono::hours>(begin - std::chrono::floor<std::chrono::days>(begin)).count();
  return {static_cast<int>(day.year()),
          static_cast<int>(static_cast<unsigned>(day.month())),
          static_cast<int>(static_cast<unsigned>(day.day())),
          static_cast<int>(of_day) + 1,
          0,
          hour.global_w_m2,
          hour.direct_normal_w_m2,
          hour.diffuse_w_m2};
}

/// The EPW of a period, with each row as `change` leaves it.
inline EpwFile epw_of(
    const std::string& period, const std::function<void(EpwRow&)>& change = [](EpwRow&) {}) {
  EpwFile file;
  for (const WeatherInterval& hour : clear_hours(period)) {
    EpwRow row = epw_row_of(hour);
    change(row);
    file.rows.push_back(row.text());
  }
  return file;
}

inline Weather weather_in(const std::string& text, const std::optional<PlaceOnEarth>& city = rotterdam) {
  const scenes::TemporaryFolder folder;
  return read_weather(folder.write("weather.epw", text), city);
}

/// What is wrong with a file, without its folder.
inline std::string complaint_about(const std::string& text, const std::optional<PlaceOnEarth>& city = rotterdam) {
  const std::string complaint = scenes::refusal_of<InputError>([&] { (void)weather_in(text, city); });
  const std::size_t name = complaint.find("weather.epw");
  return name == std::string::npos ? complaint : complaint.substr(name);
}

/// kWh/m² on a level plane.
inline double global_sum(const Weather& weather) {
  double sum = 0.0;
  for (const WeatherInterval& interval : weather.intervals)
    sum += interval.global_w_m2 * std::chrono::duration<double, std::chrono::hours::period>(interval.duration).count() / 1000.0;
  return sum;
}

}  // namespace farlod
