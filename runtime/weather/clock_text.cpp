// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/clock_text.hpp"

#include <algorithm>
#include <cstddef>

namespace farlod {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

bool is_digit(char c) { return '0' <= c && c <= '9'; }

/// Takes text from the front of what is left.
class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool ended() const { return rest_.empty(); }
  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// A number of exactly so many digits.
  std::optional<int> number(std::size_t digits) {
    if (digits_ahead() != digits) return std::nullopt;
    return first_digits(digits);
  }
  /// So many digits, whatever follows.
  std::optional<int> first_digits(std::size_t digits) {
    if (digits_ahead() < digits) return std::nullopt;
    int value = 0;
    for (const char c : rest_.substr(0, digits)) value = 10 * value + (c - '0');
    rest_.remove_prefix(digits);
    return value;
  }
  [[nodiscard]] std::size_t digits_ahead() const {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_digit);
    return static_cast<std::size_t>(end - rest_.begin());
  }
  /// Whether a time of day comes next, and no date.
  [[nodiscard]] bool at_time() const { return digits_ahead() == 2 && rest_.size() > 2 && rest_[2] == ':'; }

 private:
  std::string_view rest_;
};

/// The date's numbers; false where they are none.
bool scan_date(TextScanner& text, ClockText& result) {
  const std::size_t digits = text.digits_ahead();
  if (digits != 2 && digits != 4) return false;
  result.begins_with_year = digits == 4;
  result.date.push_back(text.first_digits(digits).value_or(0));
  while (text.take('-')) {
    const std::optional<int> number = text.number(2);
    if (!number || result.date.size() == 3) return false;
    result.date.push_back(*number);
  }
  return true;
}

/// `.5`; nothing there is no part.
std::optional<milliseconds> scan_fraction(TextScanner& text) {
  if (!text.take('.')) return milliseconds(0);
  if (text.digits_ahead() == 0) return std::nullopt;
  milliseconds part(0), unit(100);
  for (; text.digits_ahead() > 0; unit /= 10) part += text.first_digits(1).value_or(0) * unit;
  return part;
}

std::optional<milliseconds> scan_time_of_day(TextScanner& text) {
  const std::optional<int> hour = text.number(2);
  if (!hour || !text.take(':')) return std::nullopt;
  const std::optional<int> minute = text.number(2);
  const std::optional<int> second = text.take(':') ? text.number(2) : 0;
  const std::optional<milliseconds> part = scan_fraction(text);
  if (!minute || !second || !part || *minute > 59 || *second > 59) return std::nullopt;
  const milliseconds time = hours(*hour) + minutes(*minute) + seconds(*second) + *part;
  return time <= hours(24) ? std::optional(time) : std::nullopt;
}

/// `+09:00`, `+0900` or `+09`, without its sign.
std::optional<minutes> scan_offset(TextScanner& text) {
  const std::optional<int> hour = text.first_digits(2);
  if (!hour) return std::nullopt;
  const bool colon = text.take(':');
  const std::optional<int> minute = colon || !text.ended() ? text.number(2) : 0;
  if (!minute || *hour > 14 || *minute > 59) return std::nullopt;
  return hours(*hour) + minutes(*minute);
}

/// The clock that is told after the time; false where something else is.
bool scan_clock(TextScanner& text, ClockText& result) {
  if (text.ended()) return true;
  if (text.take('Z')) {
    result.ahead_of_utc = minutes(0);
  } else {
    const bool ahead = text.take('+');
    if (!ahead && !text.take('-')) return false;
    const std::optional<minutes> offset = scan_offset(text);
    if (!offset) return false;
    result.ahead_of_utc = ahead ? *offset : -*offset;
  }
  return text.ended();
}

}  // namespace

std::optional<ClockText> clock_text_in(std::string_view text) {
  TextScanner scanner(text);
  ClockText result;
  if (!scanner.at_time()) {
    if (!scan_date(scanner, result)) return std::nullopt;
    if (scanner.ended()) return result;
    if (!scanner.take('T') && !scanner.take(' ')) return std::nullopt;
  }
  result.time_of_day = scan_time_of_day(scanner);
  if (!result.time_of_day || !scan_clock(scanner, result)) return std::nullopt;
  return result;
}

}  // namespace farlod
