// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/lower_case.hpp"

/// The names of the columns of a table of points, in lower case. Both programs read such tables.
namespace farlod::point_columns {

inline constexpr std::array<std::string_view, 4> id_names{"id", "station", "name", "fid"};
inline constexpr std::array<std::string_view, 8> x_names{"x", "x_m", "easting", "lon", "longitude", "long", "lng", "lon_dd"};
inline constexpr std::array<std::string_view, 6> y_names{"y", "y_m", "northing", "lat", "latitude", "lat_dd"};
inline constexpr std::array<std::string_view, 4> z_names{"z", "z_m", "height_m", "elevation"};
/// The height of each point above the ground: the name that results have, and the same without its unit.
inline constexpr std::array<std::string_view, 2> above_ground_names{"height_above_ground_m", "height_above_ground"};
inline constexpr std::array<std::string_view, 2> azimuth_names{"azimuth", "azimuth_deg"};
inline constexpr std::array<std::string_view, 2> tilt_names{"tilt", "tilt_deg"};

/// The names of the columns that there are, so many that a line of a message holds them.
[[nodiscard]] inline std::string listed(std::span<const std::string> names) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), most); ++n) text.append(n > 0 ? ", \"" : "\"").append(names[n]).append("\"");
  return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

/// Names of columns of longitudes and latitudes.
[[nodiscard]] inline bool are_degrees(std::string_view x_name) {
  const std::string name = lower_case(std::string(x_name));
  return name.starts_with("lon") || name == "lng";
}

/// The column that has one of these names, in capitals or not. Two would leave open which one is meant: then `refuse` is called
/// with what is wrong; it throws.
template <class Refuse>
[[nodiscard]] std::optional<std::size_t> find_column(std::span<const std::string> columns,
                                                     std::span<const std::string_view> names, const Refuse& refuse) {
  std::optional<std::size_t> found;
  for (std::size_t n = 0; n < columns.size(); ++n) {
    if (std::find(names.begin(), names.end(), lower_case(columns[n])) == names.end()) continue;
    if (found)
      refuse("the columns \"" + columns[*found] + "\" and \"" + columns[n] +
             "\" mean the same; rename the one that does not count");
    found = n;
  }
  return found;
}

}  // namespace farlod::point_columns
