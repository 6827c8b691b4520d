// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/period.hpp"

#include <array>
#include <cstddef>

#include "farlod/error.hpp"
#include "weather/clock_text.hpp"

namespace farlod {
namespace {

using std::chrono::months;
using std::chrono::years;

/// The shortest thing that a part of a period names.
enum class Precision : std::uint8_t { year, month, day, minute };

constexpr int leap_year = 2000;  // of periods without a year: has all days

[[noreturn]] void refuse_period(std::string_view text, const std::string& what) {
  throw InvalidArgument("\"" + std::string(text) + "\" is no period: " + what +
                        "; write it like 2026, 2026-06, 2026-06/2026-08, 2026-06-21, 2026-06-21T10:00/16:00, or without a year, "
                        "06-21");
}

/// One of the two ends of a period.
struct PeriodPart {
  Precision precision = Precision::year;
  std::array<int, 3> date{leap_year, 1, 1};  ///< year, month, day
  std::chrono::milliseconds time_of_day{};
};

std::size_t numbers_of(Precision precision) {
  return precision == Precision::minute ? 3 : static_cast<std::size_t>(precision) + 1;
}

ClockTime begin_of(const PeriodPart& part, std::string_view text) {
  const std::chrono::year_month_day day{std::chrono::year(part.date[0]), std::chrono::month(static_cast<unsigned>(part.date[1])),
                                        std::chrono::day(static_cast<unsigned>(part.date[2]))};
  if (!day.ok()) refuse_period(text, "there is no such day");
  return std::chrono::local_days(day) + part.time_of_day;
}

/// The time at which all that a part names is over; a part that ends a span of minutes names a time alone.
ClockTime end_of(const PeriodPart& part, std::string_view text) {
  const ClockTime begin = begin_of(part, text);
  if (part.precision == Precision::minute) return begin;
  if (part.precision == Precision::day) return begin + std::chrono::days(1);
  const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(begin));
  return std::chrono::local_days(part.precision == Precision::year ? day + years(1) : day + months(1));
}

PeriodPart first_part(const ClockText& written) {
  PeriodPart part;
  const std::size_t skipped = written.begins_with_year ? 0 : 1;
  for (std::size_t n = 0; n < written.date.size(); ++n) part.date[n + skipped] = written.date[n];
  part.precision = static_cast<Precision>(written.date.size() + skipped - 1);
  part.time_of_day = written.time_of_day.value_or(part.time_of_day);
  if (written.time_of_day) part.precision = Precision::minute;
  return part;
}

ClockText written_part(std::string_view part, std::string_view text) {
  const std::optional<ClockText> written = clock_text_in(part);
  if (!written) refuse_period(text, "\"" + std::string(part) + "\" is no date or time");
  return *written;
}

PeriodPart checked_first_part(const ClockText& written, std::string_view text) {
  const std::size_t numbers = written.date.size() + (written.begins_with_year ? 0 : 1);
  if (written.date.empty()) refuse_period(text, "it begins with a time of no day");
  if (numbers > 3) refuse_period(text, "a year has four digits");
  if (written.time_of_day && numbers < 3) refuse_period(text, "a time of day needs a day before it");
  return first_part(written);
}

/// What the second part leaves out is that of the first. `of_any_year`: the first has no year.
PeriodPart second_part(const ClockText& written, const PeriodPart& first, bool of_any_year, std::string_view text) {
  PeriodPart part = first;
  const std::size_t numbers = numbers_of(first.precision), given = written.date.size();
  const bool whole_date = given == numbers;
  if (written.time_of_day.has_value() != (first.precision == Precision::minute) || given > numbers ||
      (given > 0 && whole_date != written.begins_with_year) || (whole_date && of_any_year))
    refuse_period(text, "its two ends are not alike");
  for (std::size_t n = 0; n < given; ++n) part.date[numbers - given + n] = written.date[n];
  part.time_of_day = written.time_of_day.value_or(part.time_of_day);
  return part;
}

std::optional<std::chrono::minutes> clock_of(const ClockText& first, const ClockText& second, std::string_view text) {
  if (first.ahead_of_utc && second.ahead_of_utc && *first.ahead_of_utc != *second.ahead_of_utc)
    refuse_period(text, "its two ends are of different clocks");
  return first.ahead_of_utc ? first.ahead_of_utc : second.ahead_of_utc;
}

void set_end(Period& period, PeriodPart last) {
  period.end = end_of(last, period.text);
  if (period.end > period.begin) return;
  if (!period.of_any_year) refuse_period(period.text, "it ends before it begins");
  // From November to February
  ++last.date[0];
  period.end = end_of(last, period.text);
}

}  // namespace

Period period_in(std::string_view text) {
  const std::size_t slash = text.find('/');
  const ClockText written = written_part(text.substr(0, slash), text);
  const PeriodPart first = checked_first_part(written, text);
  Period period{std::string(text), begin_of(first, text), {}, !written.begins_with_year, written.ahead_of_utc};
  if (slash == std::string_view::npos) {
    period.end = first.precision == Precision::minute ? period.begin + std::chrono::minutes(1) : end_of(first, text);
    return period;
  }
  const ClockText written_end = written_part(text.substr(slash + 1), text);
  period.clock_ahead_of_utc = clock_of(written, written_end, text);
  set_end(period, second_part(written_end, first, period.of_any_year, text));
  return period;
}

}  // namespace farlod
