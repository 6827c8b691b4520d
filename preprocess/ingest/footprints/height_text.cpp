// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/height_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace farlod::ingest {
namespace {

constexpr double metres_in_a_foot = 0.3048;
constexpr double feet_in_an_inch = 1.0 / 12.0;

struct UnitName {
  std::string_view text;
  LengthUnit unit;
};
constexpr std::array<UnitName, 20> unit_names{
    {{"m", LengthUnit::metre},        {"m.", LengthUnit::metre},      {"metre", LengthUnit::metre},
     {"metres", LengthUnit::metre},   {"meter", LengthUnit::metre},   {"meters", LengthUnit::metre},
     {"ft", LengthUnit::foot},        {"ft.", LengthUnit::foot},      {"feet", LengthUnit::foot},
     {"foot", LengthUnit::foot},      {"'", LengthUnit::foot},        {"cm", LengthUnit::centimetre},
     {"cm.", LengthUnit::centimetre}, {"mm", LengthUnit::millimetre}, {"mm.", LengthUnit::millimetre},
     {"in", LengthUnit::inch},        {"in.", LengthUnit::inch},      {"inch", LengthUnit::inch},
     {"inches", LengthUnit::inch},    {"\"", LengthUnit::inch}}};

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
  for (const UnitName& name : unit_names)
    if (unit == name.text) return metres_in(name.unit);
  return std::nullopt;
}

std::string_view without_blanks_behind(std::string_view text) { return text.substr(0, text.find_last_not_of(" \t\r\n") + 1); }

}  // namespace

double metres_in(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return 1.0;
    case LengthUnit::foot:
      return metres_in_a_foot;
    case LengthUnit::centimetre:
      return 0.01;
    case LengthUnit::millimetre:
      return 0.001;
    case LengthUnit::inch:
      break;
  }
  return feet_in_an_inch * metres_in_a_foot;
}

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
