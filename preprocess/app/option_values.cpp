// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/option_values.hpp"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "console/shard_text.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

/// The finite number that a text is.
std::optional<double> number_if_any(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' || !std::isfinite(value) ? std::nullopt : std::optional(value);
}

double required_number(const std::string& text, const std::string& option, const std::string& remedy) {
  if (const auto value = number_if_any(text)) return *value;
  throw CLI::ValidationError(option, "\"" + text + "\" is not a number: " + remedy);
}

}  // namespace

Point3d origin_in(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, ','))
    numbers.push_back(required_number(part, "--origin", "give X,Y or X,Y,Z"));
  if (numbers.size() != 2 && numbers.size() != 3) throw CLI::ValidationError("--origin", "give X,Y or X,Y,Z");
  return {numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0.0};
}

void set_alignment(const std::string& text, PackSettings& s) {
  if (text == "auto") {
    s.align = AlignMode::automatic;
  } else if (text == "none") {
    s.align = AlignMode::none;
  } else {
    s.align = AlignMode::fixed;
    const double bearing_deg = required_number(text, "--align", "give auto, none, or degrees clockwise from grid north");
    if (std::abs(bearing_deg) > 360.0) throw CLI::ValidationError("--align", "\"" + text + "\" is more than a full turn");
    s.fixed_bearing = Angle::degrees(bearing_deg);
  }
}

FarMapArea area_in(const std::string& text) {
  const std::string option = "--area";
  if (text.empty()) throw CLI::ValidationError(option, "it is empty: give X0,Y0,X1,Y1, or the name of a file");
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || !number_if_any(text.substr(0, comma))) return std::filesystem::path(text);
  std::vector<double> n;
  // split() drops what is empty after the last comma: with one more, that is the comma's own
  for (const std::string& part : CLI::detail::split(text + ',', ',')) {
    const auto number = number_if_any(part);
    if (!number) throw CLI::ValidationError(option, "\"" + text + "\" is not of the form X0,Y0,X1,Y1");
    n.push_back(*number);
  }
  if (n.size() != 4 || n[0] >= n[2] || n[1] >= n[3])
    throw CLI::ValidationError(option, "give X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1");
  constexpr double farthest_m = 1e8;  // no map is as large
  for (const double x : n)
    if (std::abs(x) > farthest_m) throw CLI::ValidationError(option, fmt::format("{:g} lies nowhere on Earth", x));
  return Box2d{{n[0], n[1]}, {n[2], n[3]}};
}

Shard shard_in(const std::string& text) {
  try {
    return shard_from(text, environment_of_process);
  } catch (const InvalidArgument& error) {
    throw CLI::ValidationError("--shard", error.what());
  }
}

std::vector<std::string> names_in(const std::string& text) {
  // As in area_in
  std::vector<std::string> names = CLI::detail::split(text + ',', ',');
  for (std::string& name : names)
    if (CLI::detail::trim(name).empty()) throw CLI::ValidationError("--ground-names", "\"" + text + "\" has an empty name");
  return names;
}

}  // namespace farlod
