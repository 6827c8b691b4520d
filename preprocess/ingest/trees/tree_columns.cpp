// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/tree_columns.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/lower_case.hpp"

namespace farlod::ingest {
namespace {

struct NamePair {
  std::string_view x, y;
  bool are_degrees;
};
constexpr std::array<NamePair, 12> known_pairs{{{"longitude", "latitude", true},
                                                {"lon", "lat", true},
                                                {"lng", "lat", true},
                                                {"long", "lat", true},
                                                {"x", "y", false},
                                                {"x_m", "y_m", false},
                                                {"easting", "northing", false},
                                                {"point_x", "point_y", false},
                                                {"x_coord", "y_coord", false},
                                                {"x_coordinate", "y_coordinate", false},
                                                {"rechtswert", "hochwert", false},
                                                {"ostwert", "nordwert", false}}};

}  // namespace

std::optional<PlaceColumns> find_place_columns(const std::vector<std::string>& names) {
  const auto column_of = [&](std::string_view wanted) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& n) { return lower_case(n) == wanted; });
    return static_cast<std::size_t>(found - names.begin());
  };
  for (const NamePair& pair : known_pairs) {
    const std::size_t x = column_of(pair.x), y = column_of(pair.y);
    if (x < names.size() && y < names.size()) return PlaceColumns{x, y, pair.are_degrees};
  }
  return std::nullopt;
}

}  // namespace farlod::ingest
