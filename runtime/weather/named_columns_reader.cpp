// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/lower_case.hpp"
#include "base/point_columns.hpp"
#include "inputs/requested_points.hpp"
#include "inputs/text_records.hpp"
#include "weather/clock_text.hpp"
#include "weather/weather_table.hpp"

/// Tables that name their columns.
namespace farlod {
namespace {

using std::chrono::milliseconds;

using WeatherNames = std::array<std::string_view, 6>;

constexpr WeatherNames begin_names{"time", "begin", "start", "time_begin", "time_utc", "period_start"},
    end_names{"end", "time_end", "period_end", "end_utc"}, middle_names{"middle", "time_middle", "period_mid", "middle_utc"},
    global_names{"global", "ghi", "global_w_m2", "ghi_w_m2", "global_horizontal"},
    direct_names{"direct", "dni", "direct_w_m2", "dni_w_m2", "direct_normal", "direct_normal_w_m2"},
    diffuse_names{"diffuse", "dhi", "diffuse_w_m2", "dhi_w_m2", "diffuse_horizontal"},
    temperature_names{"temperature", "temperature_c", "temp_air", "t2m"},
    dew_point_names{"dew_point", "dew_point_c", "temp_dew", "dewpoint"},
    humidity_names{"humidity", "relative_humidity", "rh", "humidity_percent"}, pressure_names{"pressure", "pressure_hpa"};

/// Where the columns are, and what the one of times means.
struct WeatherColumns {
  char separator = ',';
  std::size_t count = 0, time = 0;
  double middle_in_steps = 0.5;  ///< from the time of a row to the middle of its interval
  bool in_utc = false;           ///< by the name of the column
  std::optional<std::size_t> global, direct, diffuse, temperature, dew_point, humidity, pressure;
};

/// `Global [W/m2]` is `global`.
std::string plain_name(const std::string& field) {
  std::string name = lower_case(field.substr(0, field.find_first_of("([")));
  while (name.ends_with(' ')) name.pop_back();
  std::ranges::replace(name, ' ', '_');
  return name;
}

constexpr const char* name_the_columns =
    "name columns time (the beginning of each interval; or end, or middle), and global, direct (normal) and diffuse in W/m² in "
    "the "
    "first row";

void set_time_column(WeatherColumns& columns, const std::vector<std::string>& names, const std::vector<std::string>& fields,
                     const WeatherText& text, std::size_t line) {
  const auto refuse = [&](const std::string& what) { text.refuse(line, what); };
  const auto begin = point_columns::find_column(names, begin_names, refuse),
             end = point_columns::find_column(names, end_names, refuse),
             middle = point_columns::find_column(names, middle_names, refuse);
  if (!begin && !end && !middle)
    text.refuse(line, std::string("the file is no weather: no column is a time; ") + name_the_columns + ", or give an EPW");
  columns.time = middle ? *middle : begin ? *begin : *end;
  columns.middle_in_steps = middle ? 0.0 : begin ? 0.5 : -0.5;
  columns.in_utc = lower_case(fields[columns.time]).find("utc") != std::string::npos;
}

WeatherColumns columns_in(const WeatherText& text, std::size_t line) {
  WeatherColumns columns;
  columns.separator = separator_of(text.line(line));
  const std::vector<std::string> fields = text.fields(line, columns.separator);
  std::vector<std::string> names;
  std::ranges::transform(fields, std::back_inserter(names), plain_name);
  columns.count = names.size();
  set_time_column(columns, names, fields, text, line);
  const auto find = [&](const WeatherNames& any) {
    return point_columns::find_column(names, any, [&](const std::string& what) { text.refuse(line, what); });
  };
  columns.global = find(global_names);
  columns.direct = find(direct_names);
  columns.diffuse = find(diffuse_names);
  columns.temperature = find(temperature_names);
  columns.dew_point = find(dew_point_names);
  columns.humidity = find(humidity_names);
  columns.pressure = find(pressure_names);
  if (!columns.global && (!columns.direct || !columns.diffuse))
    text.refuse(line, std::string("the columns do not tell the irradiance: there is neither global, nor direct and diffuse; ") +
                          name_the_columns);
  return columns;
}

struct NamedTime {
  std::chrono::sys_time<milliseconds> utc;
  milliseconds ahead_of_utc{};
};

NamedTime time_in(const WeatherText& text, std::size_t n, const std::string& field, bool in_utc) {
  const std::optional<ClockText> time = clock_text_in(field);
  if (!time || time->date.size() != 3 || !time->begins_with_year || !time->time_of_day)
    text.refuse(n, "\"" + field + "\" is no time; write it like 2026-06-21T10:00Z or 2026-06-21T10:00+09:00");
  if (!time->ahead_of_utc && !in_utc)
    text.refuse(n, "\"" + field +
                       "\" is a time of an unknown clock; write Z or an offset such as +09:00 behind it, or name the column " +
                       "time_utc if it is UTC");
  const ClockTime clock = day_of(text, n, time->date[0], time->date[1], time->date[2]) + *time->time_of_day;
  const milliseconds ahead = time->ahead_of_utc.value_or(std::chrono::minutes(0));
  return {std::chrono::sys_time<milliseconds>(clock.time_since_epoch() - ahead), ahead};
}

/// What is empty, or says that it is nothing, is no number.
std::optional<double> number_or_nothing(const WeatherText& text, std::size_t n, const std::vector<std::string>& fields,
                                        std::optional<std::size_t> column, const char* name) {
  constexpr std::array<std::string_view, 6> nothing{"", "nan", "na", "n/a", "null", "-"};
  if (!column || std::ranges::count(nothing, lower_case(fields[*column])) > 0) return std::nullopt;
  return text.number(n, fields, *column, name);
}

WeatherRow row_of(const WeatherText& text, std::size_t n, const std::vector<std::string>& fields, const WeatherColumns& columns) {
  constexpr double largest_hpa = 2000.0, pa_a_hpa = 100.0;
  WeatherRow row;
  row.line = n;
  row.global_w_m2 = number_or_nothing(text, n, fields, columns.global, "global");
  row.direct_normal_w_m2 = number_or_nothing(text, n, fields, columns.direct, "direct");
  row.diffuse_w_m2 = number_or_nothing(text, n, fields, columns.diffuse, "diffuse");
  row.temperature_c = number_or_nothing(text, n, fields, columns.temperature, "temperature");
  row.dew_point_c = number_or_nothing(text, n, fields, columns.dew_point, "dew point");
  row.humidity_percent = number_or_nothing(text, n, fields, columns.humidity, "humidity");
  row.pressure_hpa = number_or_nothing(text, n, fields, columns.pressure, "pressure");
  // Some tables have Pa
  if (row.pressure_hpa && *row.pressure_hpa > largest_hpa) *row.pressure_hpa /= pa_a_hpa;
  return row;
}

/// The time from row to row that is met most: half of all are no longer, half no shorter.
milliseconds step_of(const std::vector<WeatherRow>& rows, const WeatherText& text) {
  constexpr milliseconds longest = std::chrono::hours(3);
  if (rows.size() < 2) text.refuse_file("a table of one row does not tell how long it lasted; give more than one");
  std::vector<milliseconds> steps;
  for (std::size_t n = 1; n < rows.size(); ++n) steps.push_back(rows[n].stamp - rows[n - 1].stamp);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  if (*middle <= milliseconds(0)) text.refuse_file("the times of the rows do not rise; sort them");
  if (*middle > longest)
    text.refuse_file("the rows are " + length_text(*middle) + " apart, in which the sun goes too far; give hours or less");
  return *middle;
}

std::size_t first_line_of(const WeatherText& text) {
  std::size_t line = 0;
  while (line < text.line_count() && (text.line(line).starts_with('#') || text.fields(line).empty())) ++line;
  return line;
}

void tell_meaning(WeatherTable& table, const WeatherColumns& columns, const std::string& name) {
  const char* meaning = columns.middle_in_steps > 0.0 ? "beginning" : columns.middle_in_steps < 0.0 ? "end" : "middle";
  table.remarks.push_back(
      fmt::format("The times of {} are taken for the {} of intervals of {}.", name, meaning, length_text(table.step)));
}

}  // namespace

WeatherTable read_named_columns(const WeatherText& text) {
  const std::size_t header = first_line_of(text);
  const WeatherColumns columns = columns_in(text, header);
  WeatherTable table;
  table.source = "the table " + text.name();
  for (std::size_t n = header + 1; n < text.line_count(); ++n) {
    const std::vector<std::string> fields = text.fields(n, columns.separator);
    if (fields.empty()) continue;
    text.require_as_long(n, fields, columns.count);
    const NamedTime time = time_in(text, n, fields[columns.time], columns.in_utc);
    // Summer time moves clocks: that of the first row counts for all
    if (table.rows.empty()) table.clock_ahead_of_utc = time.ahead_of_utc;
    table.rows.push_back(row_of(text, n, fields, columns));
    table.rows.back().stamp = ClockTime(time.utc.time_since_epoch() + table.clock_ahead_of_utc);
  }
  table.step = step_of(table.rows, text);
  table.middle_after_stamp = table.step / 2;
  // From now on, a stamp is the beginning of its interval
  const auto begin_after_time = std::chrono::round<milliseconds>((columns.middle_in_steps - 0.5) * table.step);
  for (WeatherRow& row : table.rows) row.stamp += begin_after_time;
  table.years = years_of(table.rows);
  tell_meaning(table, columns, text.name());
  return table;
}

}  // namespace farlod
