// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "weather/weather_table.hpp"

namespace farlod {
namespace {

using std::chrono::days;
using std::chrono::local_days;
using std::chrono::milliseconds;
using std::chrono::year;
using std::chrono::year_month_day;

bool has_leap_day(const std::vector<WeatherRow>& rows) {
  return std::ranges::any_of(rows, [](const WeatherRow& row) {
    const year_month_day day(std::chrono::floor<days>(row.stamp));
    return day.month() == std::chrono::February && day.day() == std::chrono::day(29);
  });
}

/// The calendar in which the rows of a table follow each other: the true one, or that of one year.
class TableCalendar {
 public:
  explicit TableCalendar(const WeatherTable& table)
      : typical_(table.years == WeatherYears::typical), year_(has_leap_day(table.rows) ? 2000 : 2001) {}

  [[nodiscard]] ClockTime time_of(ClockTime stamp) const {
    if (!typical_) return stamp;
    const auto midnight = std::chrono::floor<days>(stamp);
    const year_month_day day(midnight);
    return local_days(year_ / day.month() / day.day()) + (stamp - midnight);
  }
  /// What the rows should fill: a whole year where it is typical, and else what they begin and end with.
  [[nodiscard]] ClockTime begin(const WeatherTable& table) const {
    return typical_ ? ClockTime(local_days(year_ / 1 / 1)) : table.rows.front().stamp;
  }
  [[nodiscard]] ClockTime end(const WeatherTable& table) const {
    if (typical_) return local_days((year_ + std::chrono::years(1)) / 1 / 1);
    return table.announced_end.value_or(table.rows.back().stamp + table.step);
  }

 private:
  bool typical_;
  year year_;
};

/// A time without rows.
struct WeatherGap {
  ClockTime begin, end;
  std::size_t after_line = 0;
};

std::vector<WeatherGap> gaps_between(const WeatherTable& table, const TableCalendar& calendar, const WeatherText& text) {
  std::vector<WeatherGap> gaps;
  ClockTime end = calendar.begin(table);
  std::size_t line = table.rows.front().line;
  for (const WeatherRow& row : table.rows) {
    const ClockTime begin = calendar.time_of(row.stamp);
    if (begin < end)
      text.refuse(row.line,
                  fmt::format("the row of {} begins before that of line {} has ended; sort the rows, and keep one of each time",
                              time_text(row.stamp), line + 1));
    if (begin > end) gaps.push_back({end, begin, line});
    end = begin + table.step;
    line = row.line;
  }
  if (end < calendar.end(table)) gaps.push_back({end, calendar.end(table), line});
  return gaps;
}

/// Typical years have no year to tell.
std::string gap_time(const WeatherTable& table, ClockTime time) {
  return table.years == WeatherYears::typical ? time_text(time).substr(5) : time_text(time);
}

}  // namespace

void check_times(WeatherTable& table, const WeatherText& text) {
  const std::vector<WeatherGap> gaps = gaps_between(table, TableCalendar(table), text);
  if (gaps.empty()) return;
  milliseconds missing{};
  for (const WeatherGap& gap : gaps) missing += gap.end - gap.begin;
  const WeatherGap& first = gaps.front();
  const std::string more = gaps.size() == 1 ? "" : fmt::format(", the first of {} gaps", gaps.size());
  const bool cut_off = gaps.back().after_line == table.rows.back().line;
  table.remarks.push_back(fmt::format("{} has no rows for {}: from {} to {} (line {}){}. Sums are of the others alone.{}",
                                      text.name(), length_text(missing), gap_time(table, first.begin), gap_time(table, first.end),
                                      first.after_line + 1, more,
                                      cut_off ? " It ends early: if it was cut off, get it again." : ""));
}

}  // namespace farlod
