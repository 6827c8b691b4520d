// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/lower_case.hpp"
#include "inputs/requested_points.hpp"
#include "weather/weather_table.hpp"

/// EPW: eight lines about the place and the file, then a row for each interval, which ends at its time of local standard time
/// (EnergyPlus, Auxiliary Programs, "EnergyPlus Weather File (EPW) Data Dictionary").
namespace farlod {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;

/// Columns of a row, from 0.
enum EpwColumn : std::size_t {
  epw_year,
  epw_month,
  epw_day,
  epw_hour,
  epw_minute,
  epw_temperature = 6,
  epw_dew_point,
  epw_humidity,
  epw_pressure,
  epw_global = 13,
  epw_direct,
  epw_diffuse,
  epw_direct_lux = 17,
  epw_diffuse_lux
};

constexpr double pa_per_hpa = 100.0;

/// What the lines before the first row say.
struct EpwHeader {
  std::size_t first_row = 0;
  int records_an_hour = 1;
  std::optional<std::size_t> data_periods;  ///< the line of that name
};

void read_location(WeatherTable& table, const WeatherText& text) {
  const std::vector<std::string> fields = text.fields(0);
  const double latitude = text.number(0, fields, 6, "latitude"), longitude = text.number(0, fields, 7, "longitude"),
               zone = text.number(0, fields, 8, "time zone"), height = text.number(0, fields, 9, "elevation");
  if (std::abs(zone) > 14.0) text.refuse(0, fmt::format("the time zone {} is none; give hours ahead of UTC", zone));
  table.place = place_of(text, 0, latitude, longitude, height);
  table.clock_ahead_of_utc = std::chrono::round<milliseconds>(std::chrono::duration<double, hours::period>(zone));
  table.source = fmt::format("EPW of {}, {} ({})", fields[1], fields[3], text.name());
}

/// PVGIS writes EPW with instants, whose row is that of the hour before: 8:00 of UTC+1 is in the row of the hour from 7 to 8.
bool is_of_pvgis(const WeatherText& text) {
  const std::vector<std::string> fields = text.fields(0);
  return fields[1] == "unknown" && fields[4] == "ECMWF/ERA";
}

/// Where the middles of intervals are, from their beginnings on.
void set_middles(WeatherTable& table, const WeatherText& text) {
  table.middle_after_stamp = table.step / 2;
  if (!is_of_pvgis(text)) return;
  table.middle_after_stamp = table.step;
  table.remarks.push_back(text.name() +
                          " is an EPW of PVGIS: its rows are taken for instants, which may be half an hour off. The CSV of "
                          "PVGIS says when they are; take it.");
}

EpwHeader header_of(const WeatherText& text) {
  EpwHeader header;
  for (; header.first_row < text.line_count(); ++header.first_row) {
    const std::vector<std::string> fields = text.fields(header.first_row);
    if (fields.empty()) continue;
    if (number_in(fields.front())) break;
    if (lower_case(fields.front()) == "data periods") header.data_periods = header.first_row;
  }
  if (header.first_row == text.line_count())
    text.refuse_file("the file ends before its first hour: it was cut off; get it again");
  if (!header.data_periods) return header;
  const std::size_t line = *header.data_periods;
  header.records_an_hour = text.whole_number(line, text.fields(line), 2, "number of records an hour");
  if (header.records_an_hour < 1 || 60 % header.records_an_hour != 0)
    text.refuse(line, fmt::format("there cannot be {} records an hour; give a number that divides 60", header.records_an_hour));
  return header;
}

/// Numbers that nobody needs may be left out, or be anything.
std::optional<double> if_number(const std::vector<std::string>& fields, std::size_t column) {
  return column < fields.size() ? number_in(fields[column]) : std::nullopt;
}

/// The stamp is that of the end of the hour, with minutes apart.
WeatherRow epw_row(const WeatherText& text, std::size_t n, const std::vector<std::string>& fields) {
  WeatherRow row;
  row.line = n;
  row.stamp = day_of(text, n, text.whole_number(n, fields, epw_year, "year"), text.whole_number(n, fields, epw_month, "month"),
                     text.whole_number(n, fields, epw_day, "day"));
  const int hour = text.whole_number(n, fields, epw_hour, "hour");
  if (hour < 1 || hour > 24) text.refuse(n, fmt::format("the hour is {}; EPW counts hours from 1 to 24", hour));
  row.stamp += hours(hour);
  row.global_w_m2 = text.number(n, fields, epw_global, "global horizontal radiation");
  row.direct_normal_w_m2 = text.number(n, fields, epw_direct, "direct normal radiation");
  row.diffuse_w_m2 = text.number(n, fields, epw_diffuse, "diffuse horizontal radiation");
  row.direct_normal_lux = if_number(fields, epw_direct_lux);
  row.diffuse_lux = if_number(fields, epw_diffuse_lux);
  row.temperature_c = if_number(fields, epw_temperature);
  row.dew_point_c = if_number(fields, epw_dew_point);
  row.humidity_percent = if_number(fields, epw_humidity);
  row.pressure_hpa = if_number(fields, epw_pressure);
  if (row.pressure_hpa) *row.pressure_hpa /= pa_per_hpa;
  return row;
}

/// Minutes of rows, in their order. Of one row an hour they say nothing: files write 0, 60 or 30 for the same.
void add_minutes(WeatherTable& table, const std::vector<int>& minutes_of_rows, int records_an_hour, const WeatherText& text) {
  if (records_an_hour == 1) return;
  // Some count 15, 30, 45, 60, and some 0, 15, 30, 45
  const bool from_0 = std::ranges::count(minutes_of_rows, 0) > 0 && std::ranges::count(minutes_of_rows, 60) == 0;
  const int step = 60 / records_an_hour;
  for (std::size_t n = 0; n < table.rows.size(); ++n) {
    const int minute = minutes_of_rows[n];
    if (minute % step != 0)
      text.refuse(table.rows[n].line,
                  fmt::format("the minute is {}, where the file has {} rows an hour", minute, records_an_hour));
    table.rows[n].stamp += minutes(from_0 ? minute + step : minute) - hours(1);
  }
  table.remarks.push_back(
      fmt::format("{} has {} rows an hour: its irradiances are taken for means in W/m².", text.name(), records_an_hour));
}

/// `12/31` or `12/31/2019`, with blanks. A file whose last row is of another year announces none.
std::optional<ClockTime> announced_end(const std::string& field, ClockTime last) {
  std::string date = field;
  std::erase(date, ' ');
  const std::size_t slash = date.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const std::optional<double> month = number_in(date.substr(0, slash)),
                              day = number_in(date.substr(slash + 1, date.find('/', slash + 1) - slash - 1));
  if (!month || !day || *month < 1.0 || *day < 1.0 || *month > 12.0 || *day > 31.0) return std::nullopt;
  // The last row ends a day at its 24 h
  const std::chrono::year_month_day of_last(std::chrono::floor<std::chrono::days>(last - milliseconds(1)));
  const std::chrono::year_month_day end{of_last.year(), std::chrono::month(static_cast<unsigned>(*month)),
                                        std::chrono::day(static_cast<unsigned>(*day))};
  if (!end.ok()) return std::nullopt;
  return std::chrono::local_days(end) + std::chrono::days(1);
}

}  // namespace

bool is_epw(const WeatherText& text) { return lower_case(std::string(text.line(0).substr(0, 9))) == "location,"; }

WeatherTable read_epw(const WeatherText& text) {
  WeatherTable table;
  read_location(table, text);
  const EpwHeader header = header_of(text);
  const std::size_t columns = text.fields(header.first_row).size();
  std::vector<int> minutes_of_rows;
  for (std::size_t n = header.first_row; n < text.line_count(); ++n) {
    const std::vector<std::string> fields = text.fields(n);
    if (fields.empty()) continue;
    text.require_as_long(n, fields, columns);
    table.rows.push_back(epw_row(text, n, fields));
    minutes_of_rows.push_back(text.whole_number(n, fields, epw_minute, "minute"));
    if (minutes_of_rows.back() < 0 || minutes_of_rows.back() > 60)
      text.refuse(n, fmt::format("the minute is {}; EPW counts minutes to 60", minutes_of_rows.back()));
  }
  add_minutes(table, minutes_of_rows, header.records_an_hour, text);
  table.step = milliseconds(hours(1)) / header.records_an_hour;
  for (WeatherRow& row : table.rows) row.stamp -= table.step;  // from now on that of the beginning
  set_middles(table, text);
  table.years = years_of(table.rows);
  if (header.data_periods && table.years == WeatherYears::measured) {
    const std::vector<std::string> fields = text.fields(*header.data_periods);
    if (fields.size() > 6) table.announced_end = announced_end(fields.back(), table.rows.back().stamp + table.step);
  }
  return table;
}

}  // namespace farlod
