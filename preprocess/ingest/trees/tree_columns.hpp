// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace farlod::ingest {

/// The two columns of a table that hold the places of its rows.
struct PlaceColumns {
  std::size_t x = 0, y = 0;
  bool are_degrees = false;  ///< longitudes and latitudes
};

/// Finds them by their names, in capitals or not, in any order. Degrees count where a table has them beside other coordinates.
[[nodiscard]] std::optional<PlaceColumns> find_place_columns(const std::vector<std::string>& names);

}  // namespace farlod::ingest
