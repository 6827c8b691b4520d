// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/value_text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/expects.hpp"

namespace farlod {
namespace {

// The longest: a sign, "0.", the zeros of the smallest number (or the digits of the largest one), and 17 digits
constexpr std::size_t longest_decimal = std::numeric_limits<double>::max_exponent10 + 32;

template <class... Precision>
void append_fixed(std::string& text, auto value, Precision... precision) {
  FARLOD_EXPECTS(std::isfinite(value));
  std::array<char, longest_decimal> digits;
  // Adding zero turns -0 into 0
  const auto end =
      std::to_chars(digits.begin(), digits.end(), value + decltype(value){0}, std::chars_format::fixed, precision...);
  FARLOD_EXPECTS(end.ec == std::errc());
  text.append(digits.data(), end.ptr);
}

template <class... Precision>
std::string fixed(auto value, Precision... precision) {
  std::string text;
  append_fixed(text, value, precision...);
  return text;
}

/// Below this, a double has more than three certain digits after the point, so that rounding to three is exact.
constexpr double most_metres_as_millimetres = 1e12;

}  // namespace

std::string shortest_decimal(double value) { return fixed(value); }
std::string shortest_decimal(float value) { return fixed(value); }
std::string svf_decimal(double value) { return fixed(value, 6); }

void append_millimetres(std::string& text, double value) {
  FARLOD_EXPECTS(std::isfinite(value));
  if (std::abs(value) >= most_metres_as_millimetres) return append_fixed(text, std::round(value * 1e3) / 1e3);
  const auto millimetres = static_cast<std::int64_t>(std::round(value * 1e3));
  if (millimetres < 0) text += '-';
  const auto size = static_cast<std::uint64_t>(millimetres < 0 ? -millimetres : millimetres);
  append_whole(text, size / 1000);
  std::uint64_t rest = size % 1000;
  if (rest == 0) return;
  text += '.';
  for (std::uint64_t unit = 100; rest != 0; rest %= unit, unit /= 10) text += static_cast<char>('0' + rest / unit);
}

void append_degrees(std::string& text, double value) { append_fixed(text, value, 8); }

void append_svf(std::string& text, double value) { append_fixed(text, value, 6); }

void append_whole(std::string& text, std::uint64_t number) {
  std::array<char, std::numeric_limits<std::uint64_t>::digits10 + 1> digits;
  const auto end = std::to_chars(digits.begin(), digits.end(), number);
  text.append(digits.data(), end.ptr);
}

void append_json_text(std::string& json, std::string_view text) {
  json += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      json += c;
    } else {
      std::array<char, 7> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(c));
      json += escape.data();
    }
  }
  json += '"';
}

}  // namespace farlod
