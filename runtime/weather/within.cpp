// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "farlod/error.hpp"
#include "weather/weather.hpp"
#include "weather/weather_table.hpp"

namespace farlod {
namespace {

using std::chrono::days;
using std::chrono::local_days;
using std::chrono::milliseconds;
using std::chrono::year;
using std::chrono::year_month_day;
using std::chrono::years;

/// An interval on the clock of a period, moved to a year of it, and cut by its borders.
struct PeriodPiece {
  ClockTime begin;
  WeatherInterval interval;
};

/// What falls within [begin, end) of intervals that are moved by `moved` on the clock.
class PieceCutter {
 public:
  PieceCutter(ClockTime begin, ClockTime end, milliseconds clock_ahead) : begin_(begin), end_(end), clock_ahead_(clock_ahead) {}

  [[nodiscard]] ClockTime begin_of(const WeatherInterval& interval) const {
    return ClockTime(interval.middle_utc.time_since_epoch() + clock_ahead_) - interval.duration / 2;
  }
  void add(const WeatherInterval& interval, milliseconds moved) {
    const ClockTime from = begin_of(interval) + moved, to = from + interval.duration;
    const ClockTime first = std::max(from, begin_), last = std::min(to, end_);
    if (first >= last) return;
    PeriodPiece piece{first, interval};
    piece.interval.duration = last - first;
    piece.interval.middle_utc += (first - from) + (last - first) / 2 - interval.duration / 2;
    pieces.push_back(piece);
  }

  std::vector<PeriodPiece> pieces;

 private:
  ClockTime begin_, end_;
  milliseconds clock_ahead_;
};

year year_of(ClockTime time) { return year_month_day(std::chrono::floor<days>(time)).year(); }

/// By how much a time has to be moved to be in another year; none where this has no such day.
std::optional<milliseconds> way_to_year(ClockTime time, year other) {
  const auto midnight = std::chrono::floor<days>(time);
  const year_month_day day(midnight);
  const year_month_day there = other / day.month() / day.day();
  if (!there.ok()) return std::nullopt;
  return local_days(there) - midnight;
}

/// Typical weather falls in each year of the period; a winter's in two, and an interval may lie across a new year.
void add_typical(PieceCutter& cutter, const Weather& weather, ClockTime begin, ClockTime end) {
  for (const WeatherInterval& interval : weather.intervals) {
    const ClockTime from = cutter.begin_of(interval);
    for (year y = year_of(begin) - years(1); y <= year_of(end); ++y)
      if (const auto moved = way_to_year(from, y)) cutter.add(interval, *moved);
  }
}

std::vector<PeriodPiece> pieces_of(const Weather& weather, const Period& period, milliseconds clock_ahead) {
  constexpr milliseconds longest_typical = days(366);
  PieceCutter cutter(period.begin, period.end, clock_ahead);
  if (weather.years == WeatherYears::measured) {
    for (const WeatherInterval& interval : weather.intervals) cutter.add(interval, milliseconds(0));
  } else {
    if (period.end - period.begin > longest_typical)
      throw InputError(fmt::format("the weather ({}) is that of one typical year, and {} is longer; give a year at most",
                                   weather.source, period.text));
    add_typical(cutter, weather, period.begin, period.end);
  }
  return std::move(cutter.pieces);
}

/// A period of any year, in a year; none that lacks its first day.
std::optional<Period> in_year(const Period& period, year y) {
  const auto to_begin = way_to_year(period.begin, y);
  if (!to_begin) return std::nullopt;
  // Without a 29th of February, what ends with it ends a day earlier
  const auto to_end = way_to_year(period.end, y + (year_of(period.end) - year_of(period.begin)));
  Period result = period;
  result.begin += *to_begin;
  result.end += to_end.value_or(*to_begin);
  return result;
}

milliseconds length_of(const std::vector<PeriodPiece>& pieces) {
  milliseconds length{};
  for (const PeriodPiece& piece : pieces) length += piece.interval.duration;
  return length;
}

/// A period of any year, in the one that has most of it.
Period in_some_year(const Weather& weather, const Period& period, milliseconds clock_ahead) {
  const PieceCutter clock({}, {}, clock_ahead);
  const bool typical = weather.years == WeatherYears::typical;
  // Typical weather with a 29th of February, and without
  const year first = typical ? year(2000) : year_of(clock.begin_of(weather.intervals.front())) - years(1);
  const year last = typical ? year(2001) : year_of(clock.begin_of(weather.intervals.back()));
  Period best = period;
  milliseconds most{}, second{};
  for (year y = first; y <= last; ++y) {
    const std::optional<Period> there = in_year(period, y);
    if (!there) continue;
    const milliseconds length = length_of(pieces_of(weather, *there, clock_ahead));
    second = std::max(second, std::min(length, most));
    // The one that lacks less, where two have the same
    if (length < most || (length == most && there->end - there->begin >= best.end - best.begin)) continue;
    most = std::max(most, length);
    best = *there;
  }
  if (!typical && 2 * second > most)
    throw InputError(fmt::format("the weather ({}) has \"{}\" of more than one year; write which, such as {}-{}", weather.source,
                                 period.text, static_cast<int>(year_of(best.begin)), period.text));
  return best;
}

[[noreturn]] void refuse_period_without_weather(const Weather& weather, const Period& period, milliseconds clock_ahead) {
  const PieceCutter clock({}, {}, clock_ahead);
  const WeatherInterval& last = weather.intervals.back();
  throw InputError(fmt::format(
      "the weather ({}) has nothing of {}: it is that of {} to {}; choose a period of it, or leave out the year", weather.source,
      period.text, time_text(clock.begin_of(weather.intervals.front())), time_text(clock.begin_of(last) + last.duration)));
}

/// What lies between the pieces of a period.
void tell_lack(Weather& result, const std::vector<PeriodPiece>& pieces, const Period& period) {
  milliseconds missing{};
  std::optional<ClockTime> first;
  ClockTime until = period.begin;
  const auto pass = [&](ClockTime next) {
    if (next <= until) return;
    missing += next - until;
    if (!first) first = until;
  };
  for (const PeriodPiece& piece : pieces) {
    pass(piece.begin);
    until = std::max(until, piece.begin + piece.interval.duration);
  }
  pass(period.end);
  if (!first) return;
  // A typical year has no year to tell
  const std::string when = time_text(*first).substr(period.of_any_year && result.years == WeatherYears::typical ? 5 : 0);
  result.remarks.push_back(fmt::format("Of the {} of {}, the weather lacks {}, the first at {}: sums are of the others alone.",
                                       length_text(period.end - period.begin), period.text, length_text(missing), when));
}

}  // namespace

Weather within(const Weather& weather, const Period& period) {
  const milliseconds clock_ahead = period.clock_ahead_of_utc ? *period.clock_ahead_of_utc : weather.clock_ahead_of_utc;
  if (weather.intervals.empty()) throw InputError("the weather (" + weather.source + ") is empty");
  const Period meant = period.of_any_year ? in_some_year(weather, period, clock_ahead) : period;
  std::vector<PeriodPiece> pieces = pieces_of(weather, meant, clock_ahead);
  if (pieces.empty()) refuse_period_without_weather(weather, period, clock_ahead);
  std::ranges::stable_sort(pieces, {}, &PeriodPiece::begin);
  Weather result = weather;
  result.clock_ahead_of_utc = clock_ahead;
  result.intervals.clear();
  for (const PeriodPiece& piece : pieces) result.intervals.push_back(piece.interval);
  tell_lack(result, pieces, meant);
  return result;
}

std::chrono::month month_of(const Weather& weather, const WeatherInterval& interval) {
  const ClockTime middle(interval.middle_utc.time_since_epoch() + weather.clock_ahead_of_utc);
  return year_month_day(std::chrono::floor<days>(middle)).month();
}

}  // namespace farlod
