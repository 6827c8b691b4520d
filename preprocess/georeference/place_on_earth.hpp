// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod::georeference {

/// Where a city lies, for people.
struct PlaceOnEarth {
  std::optional<Point2d> lon_lat_deg;  ///< WGS 84, to within some metres
  std::string country;                 ///< that the CRS is meant for, where the city lies there; empty where it is not for one
};

/// The place of the origin of the city frame.
[[nodiscard]] PlaceOnEarth place_of(const Georeference& georeference);

/// The country in the name of an area of the EPSG register: its first words. Empty for zones, continents and lists.
[[nodiscard]] std::string country_in(std::string_view area_name);

/// "57.59° N, 9.10° E".
[[nodiscard]] std::string degrees_text(Point2d lon_lat_deg);

}  // namespace farlod::georeference
