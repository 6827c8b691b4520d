// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/lower_case.hpp"
#include "inputs/requested_points.hpp"
#include "weather/weather_table.hpp"

/// Typical years of PVGIS (JRC, user manual of PVGIS 5.3, "TMY") and of NREL (S. Wilcox and W. Marion, Users Manual for TMY3 Data
/// Sets, NREL/TP-581-43156).
namespace farlod {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;

/// Where the columns of a table of known names are.
class TmyColumns {
 public:
  TmyColumns(const WeatherText& text, std::size_t line) : text_(text), line_(line), names_(text.fields(line)) {}

  [[nodiscard]] std::size_t count() const { return names_.size(); }
  [[nodiscard]] std::size_t of(const char* name) const {
    const auto found = std::ranges::find(names_, std::string(name));
    if (found == names_.end())
      text_.refuse(line_, fmt::format("there is no column {}: the file was changed; get it again", name));
    return static_cast<std::size_t>(found - names_.begin());
  }
  /// The number in a column that some files lack.
  [[nodiscard]] std::optional<double> if_any(const std::vector<std::string>& fields, const char* name) const {
    const auto found = static_cast<std::size_t>(std::ranges::find(names_, std::string(name)) - names_.begin());
    return found < fields.size() ? number_in(fields[found]) : std::nullopt;
  }

 private:
  const WeatherText& text_;
  std::size_t line_;
  std::vector<std::string> names_;
};

/// A number of so many digits at a place of a field, and nothing else.
std::optional<int> digits_at(const std::string& field, std::size_t begin, std::size_t count) {
  if (field.size() < begin + count) return std::nullopt;
  int value = 0;
  for (const char c : field.substr(begin, count)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

/// A length of time in hours, of at most a day. Refuses any other as line `n`.
milliseconds hours_of(const WeatherText& text, std::size_t n, double value) {
  constexpr double longest = 24.0;
  if (std::abs(value) > longest) text.refuse(n, fmt::format("{} hours are more than a day; correct them", value));
  return std::chrono::round<milliseconds>(std::chrono::duration<double, hours::period>(value));
}

constexpr std::string_view pvgis_first_column = "time(UTC)";
constexpr std::size_t pvgis_header_lines = 60;  // at most; there are 17 or 18

std::optional<std::size_t> pvgis_column_line(const WeatherText& text) {
  for (std::size_t n = 0; n < std::min(text.line_count(), pvgis_header_lines); ++n)
    if (text.line(n).starts_with(pvgis_first_column)) return n;
  return std::nullopt;
}

/// The number after the colon of a line that begins so, above the table.
std::optional<double> pvgis_fact(const WeatherText& text, std::size_t column_line, std::string_view begin) {
  for (std::size_t n = 0; n < column_line; ++n) {
    const std::string_view line = text.line(n);
    if (!line.starts_with(begin)) continue;
    return text.number(n, text.fields(n, ':'), 1, std::string(begin).c_str());
  }
  return std::nullopt;
}

/// `20090131:2300`.
ClockTime pvgis_stamp(const WeatherText& text, std::size_t n, const std::string& field) {
  const std::optional<int> y = digits_at(field, 0, 4), month = digits_at(field, 4, 2), day = digits_at(field, 6, 2),
                           hour = digits_at(field, 9, 2), minute = digits_at(field, 11, 2);
  if (field.size() != 13 || field[8] != ':' || !y || !month || !day || !hour || !minute || *hour > 23 || *minute > 59)
    text.refuse(n, "\"" + field + "\" is no time of PVGIS, such as 20090131:2300");
  return day_of(text, n, *y, *month, *day) + hours(*hour) + minutes(*minute);
}

void read_pvgis_header(WeatherTable& table, const WeatherText& text, std::size_t column_line) {
  const auto latitude = pvgis_fact(text, column_line, "Latitude"), longitude = pvgis_fact(text, column_line, "Longitude"),
             height = pvgis_fact(text, column_line, "Elevation"),
             offset = pvgis_fact(text, column_line, "Irradiance Time Offset");
  if (latitude && longitude) table.place = place_of(text, 0, *latitude, *longitude, height.value_or(0.0));
  // Satellites see all in an instant; it is the middle of the hour that it stands for
  table.middle_after_stamp = hours_of(text, 0, offset.value_or(0.0));
  if (!offset)
    table.remarks.push_back(text.name() +
                            " has no \"Irradiance Time Offset\", as files of PVGIS since 5.2 have: each row is taken for "
                            "the instant of its time.");
}

WeatherRow pvgis_row(const WeatherText& text, std::size_t n, const TmyColumns& columns) {
  const std::vector<std::string> fields = text.fields(n);
  text.require_as_long(n, fields, columns.count());
  WeatherRow row;
  row.line = n;
  row.stamp = pvgis_stamp(text, n, fields[0]);
  row.global_w_m2 = text.number(n, fields, columns.of("G(h)"), "G(h)");
  row.direct_normal_w_m2 = text.number(n, fields, columns.of("Gb(n)"), "Gb(n)");
  row.diffuse_w_m2 = text.number(n, fields, columns.of("Gd(h)"), "Gd(h)");
  row.temperature_c = columns.if_any(fields, "T2m");
  row.humidity_percent = columns.if_any(fields, "RH");
  row.pressure_hpa = columns.if_any(fields, "SP");
  if (row.pressure_hpa) *row.pressure_hpa /= 100.0;
  return row;
}

constexpr std::string_view tmy3_first_column = "Date (MM/DD/YYYY)";

/// Two fields: `01/31/1988`, and the end of the hour, `01:00` to `24:00`. The stamp is that of the beginning.
ClockTime tmy3_stamp(const WeatherText& text, std::size_t n, const std::string& date, const std::string& time) {
  const std::optional<int> month = digits_at(date, 0, 2), day = digits_at(date, 3, 2), y = digits_at(date, 6, 4),
                           hour = digits_at(time, 0, 2), minute = digits_at(time, 3, 2);
  if (date.size() != 10 || time.size() != 5 || !month || !day || !y || !hour || !minute)
    text.refuse(n, "\"" + date + "," + time + "\" is no time of TMY3, such as 01/31/1988,24:00");
  if (*hour < 1 || *hour > 24 || *minute != 0) text.refuse(n, "the time is " + time + "; TMY3 counts from 01:00 to 24:00");
  return day_of(text, n, *y, *month, *day) + hours(*hour - 1);
}

WeatherRow tmy3_row(const WeatherText& text, std::size_t n, const TmyColumns& columns) {
  const std::vector<std::string> fields = text.fields(n);
  text.require_as_long(n, fields, columns.count());
  WeatherRow row;
  row.line = n;
  row.stamp = tmy3_stamp(text, n, fields[0], fields[1]);
  row.global_w_m2 = text.number(n, fields, columns.of("GHI (W/m^2)"), "GHI");
  row.direct_normal_w_m2 = text.number(n, fields, columns.of("DNI (W/m^2)"), "DNI");
  row.diffuse_w_m2 = text.number(n, fields, columns.of("DHI (W/m^2)"), "DHI");
  row.direct_normal_lux = columns.if_any(fields, "DN illum (lx)");
  row.diffuse_lux = columns.if_any(fields, "DH illum (lx)");
  row.temperature_c = columns.if_any(fields, "Dry-bulb (C)");
  row.dew_point_c = columns.if_any(fields, "Dew-point (C)");
  row.humidity_percent = columns.if_any(fields, "RHum (%)");
  row.pressure_hpa = columns.if_any(fields, "Pressure (mbar)");
  return row;
}

}  // namespace

bool is_pvgis_tmy(const WeatherText& text) { return pvgis_column_line(text).has_value(); }

WeatherTable read_pvgis_tmy(const WeatherText& text) {
  const std::size_t column_line = pvgis_column_line(text).value_or(0);
  const TmyColumns columns(text, column_line);
  WeatherTable table;
  table.source = "TMY of PVGIS (" + text.name() + ")";
  table.step = hours(1);
  table.years = WeatherYears::typical;
  read_pvgis_header(table, text, column_line);
  // The table ends at an empty line, below which its columns are explained
  for (std::size_t n = column_line + 1; n < text.line_count() && !text.fields(n).empty(); ++n)
    table.rows.push_back(pvgis_row(text, n, columns));
  return table;
}

bool is_tmy3(const WeatherText& text) { return text.line(1).starts_with(tmy3_first_column); }

WeatherTable read_tmy3(const WeatherText& text) {
  const std::vector<std::string> station = text.fields(0);
  const TmyColumns columns(text, 1);
  WeatherTable table;
  table.place = place_of(text, 0, text.number(0, station, 4, "latitude"), text.number(0, station, 5, "longitude"),
                         text.number(0, station, 6, "elevation"));
  table.clock_ahead_of_utc = hours_of(text, 0, text.number(0, station, 3, "time zone"));
  table.source = fmt::format("TMY3 of {}, {} ({})", station[1], station[2], text.name());
  table.step = hours(1);
  table.middle_after_stamp = minutes(30);
  table.years = WeatherYears::typical;
  for (std::size_t n = 2; n < text.line_count(); ++n)
    if (!text.fields(n).empty()) table.rows.push_back(tmy3_row(text, n, columns));
  return table;
}

}  // namespace farlod
