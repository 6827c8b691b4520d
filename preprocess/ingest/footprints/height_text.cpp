// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/height_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace farlod::ingest {
namespace {

constexpr double metres_in_a_foot = 0.3048;
constexpr double feet_in_an_inch = 1.0 / 12.0;

void skip_blanks(std::string_view& text) { text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size())); }

std::optional<double> take_number(std::string_view& text) {
  skip_blanks(text);
  // An approximate height is taken as it is
  if (text.starts_with('~')) text.remove_prefix(1);
  skip_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  // A comma is a decimal point, as in many countries: no height has so many metres that it needs a separator of thousands
  std::string pointed(text.substr(0, text.find_first_not_of("0123456789.,eE+-")));
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(pointed.data(), pointed.data() + pointed.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - pointed.data()));
  skip_blanks(text);
  return value;
}

std::optional<double> unit_m(std::string_view unit, LengthUnit plain) {
  if (unit.empty()) return metres_in(plain);
  for (const std::string_view name : {"m", "m.", "metre", "metres", "meter", "meters"})
    if (unit == name) return 1.0;
  for (const std::string_view name : {"ft", "ft.", "feet", "foot", "'"})
    if (unit == name) return metres_in_a_foot;
  return std::nullopt;
}

std::string_view without_blanks_behind(std::string_view text) { return text.substr(0, text.find_last_not_of(" \t\r\n") + 1); }

}  // namespace

double metres_in(LengthUnit unit) { return unit == LengthUnit::foot ? metres_in_a_foot : 1.0; }

std::optional<double> length_m_from(std::string_view text, LengthUnit plain) {
  text = without_blanks_behind(text);
  const std::optional<double> number = take_number(text);
  if (!number) return std::nullopt;
  if (text.starts_with('\'') && text.size() > 1) {
    text.remove_prefix(1);
    const std::optional<double> inches = take_number(text);
    const bool ends_well = text.empty() || text == "\"" || text == "''";
    if (!inches || !ends_well) return std::nullopt;
    return (*number + *inches * feet_in_an_inch) * metres_in_a_foot;
  }
  const std::optional<double> unit = unit_m(text, plain);
  return unit ? std::optional(*number * *unit) : std::nullopt;
}

std::optional<double> number_from(std::string_view text) {
  text = without_blanks_behind(text);
  const std::optional<double> number = take_number(text);
  return text.empty() ? number : std::nullopt;
}

}  // namespace farlod::ingest
