// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/decimal.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

// The longest: a sign, "0.", the zeros of the smallest number (or the digits of the largest one), and 17 digits
constexpr std::size_t longest_decimal = std::numeric_limits<double>::max_exponent10 + 32;

template <class... Precision>
std::string fixed(auto value, Precision... precision) {
  FARLOD_EXPECTS(std::isfinite(value));
  std::array<char, longest_decimal> text;
  // Adding zero turns -0 into 0
  const auto end = std::to_chars(text.begin(), text.end(), value + decltype(value){0}, std::chars_format::fixed, precision...);
  FARLOD_EXPECTS(end.ec == std::errc());
  return {text.data(), end.ptr};
}

}  // namespace

std::string shortest_decimal(double value) { return fixed(value); }
std::string shortest_decimal(float value) { return fixed(value); }
std::string millimetre_decimal(double value) { return fixed(std::round(value * 1e3) / 1e3); }
std::string share_decimal(double value) { return fixed(value, 6); }

}  // namespace farlod
