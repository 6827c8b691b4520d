// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "farlod/error.hpp"

namespace farlod {
namespace {

/// Streets wider than this share of their spacing would leave no room for a block between two wide ones.
constexpr double largest_street_share = 0.25;

/// Frequent codes of CRSs in degrees. Others are not recognized, since the generator does not use PROJ.
constexpr std::array well_known_geographic_codes{4258, 4269, 4326, 4612, 4979, 6668, 6697};

void check_street(std::string_view name, double width_m, double spacing_m) {
  if (width_m > largest_street_share * spacing_m)
    throw InvalidArgument(
        fmt::format("--{0}-width is {1:g} m, more than a quarter of the {2:g} m between two {0}s: narrow it, or raise "
                    "--{0}-spacing and --size",
                    name, width_m, spacing_m));
}

void check_combination(const CitySettings& settings) {
  const auto need_roofs = [&](std::string_view name, bool asked) {
    if (asked && settings.lod < 2) throw InvalidArgument(fmt::format("--{} has no place on prisms: add --lod 2", name));
  };
  need_roofs("eaves", settings.eaves_m > 0.0);
  need_roofs("balconies", settings.balconies);
  need_roofs("facade-details", settings.facade_details);
  if (settings.hillside && settings.terrain_relief_m > 0.0)
    throw InvalidArgument("--hillside has slopes of its own: leave out --terrain-relief");
}

}  // namespace

void check(const CitySettings& settings) {
  CitySettings::describe(settings, [](std::string_view name, auto value, SettingRange range, auto&&...) {
    const auto number = static_cast<double>(value);
    // The negation also refuses NaN
    if (!(number >= range.low && number <= range.high))
      throw InvalidArgument(
          fmt::format("--{} is {:.12g}; it must be between {:.12g} and {:.12g}", name, number, range.low, range.high));
  });
  // A city smaller than the spacing is one block
  check_street("avenue", settings.avenue_width_m, std::min(settings.avenue_spacing_m, settings.size_m));
  check_street("street", settings.street_width_m, std::min(settings.street_spacing_m, settings.size_m));
  check_combination(settings);
  if (settings.epsg <= 0) throw InvalidArgument("--crs must be like EPSG:32632");
  if (std::ranges::count(well_known_geographic_codes, settings.epsg) > 0)
    throw InvalidArgument(
        fmt::format("--crs EPSG:{} is in degrees; name a projected one in metres, such as EPSG:32632", settings.epsg));
}

std::optional<int> epsg_code(std::string_view text) {
  constexpr std::string_view prefix = "epsg:";
  if (text.size() <= prefix.size()) return std::nullopt;
  const bool named = std::ranges::equal(text.substr(0, prefix.size()), prefix,
                                        [](char a, char b) { return a == b || (a >= 'A' && a <= 'Z' && a + ('a' - 'A') == b); });
  int code = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + prefix.size(), end, code);
  if (!named || error != std::errc{} || rest != end || code <= 0) return std::nullopt;
  return code;
}

}  // namespace farlod
