// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "city/city_model.hpp"

namespace farlod::georeference {

/// No facet of a city is wider than this, and no city has a gap of twice as much between a few buildings and all others.
inline constexpr double city_square_m = 10'000.0;

/// Facets of a building that are not where the city is.
struct MisplacedFacets {
  std::size_t building = 0;         ///< row in CityModel::buildings
  std::vector<std::size_t> facets;  ///< rows in CityModel::facets, ascending
  bool all_of_it = false;           ///< nothing of the building can be kept: these are all of its facets
  Point3d first_vertex;             ///< that is not in the city
};

/// Which facets of a projected city (metres) cannot be part of it, by building, in order.
///   (1) the city is the greatest cluster of squares of 10 km that touch, counted by facets, and every other cluster that has
///       more than ten buildings or more than half as many facets
///   (2) a facet of which no vertex is in the city is misplaced; so is one that is wider than 10 km, or has a vertex that is
///       nowhere (not finite)
///   (3) where such a facet has one vertex in the city, and so bounds the building with another, the building is misplaced whole
[[nodiscard]] std::vector<MisplacedFacets> find_misplaced(const CityModel& city);

/// Takes those facets out of the city, and buildings that have no others.
void leave_out(CityModel& city, const std::vector<MisplacedFacets>& misplaced);

}  // namespace farlod::georeference
