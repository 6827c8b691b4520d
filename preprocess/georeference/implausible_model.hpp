// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"

namespace farlod::georeference {

/// No facet of a city is wider than this, and no city has a gap of twice this width between a few buildings and all others.
inline constexpr double city_square_m = 10'000.0;

/// The facets of a building that do not lie in the city.
struct MisplacedFacets {
  std::size_t building = 0;         ///< row in CityModel::buildings
  std::vector<std::size_t> facets;  ///< rows in CityModel::facets, ascending
  bool all_of_it = false;           ///< `facets` are all facets of the building: none of it can be kept
  Point3d first_vertex;             ///< the first vertex that is not in the city
};

/// The facets of a projected model (metres) that cannot be part of the city, for each building, in order.
///   (1) squares of 10 km that contain facets and touch form clusters; the city is the cluster with most facets, and every other
///       cluster with more than ten buildings or more than half as many facets, with the squares around them
///   (2) a facet is misplaced if one of its vertices is not in the city or not finite, or if it is wider than 10 km
///   (3) if a misplaced facet has another vertex in the city, the whole building is misplaced
[[nodiscard]] std::vector<MisplacedFacets> find_misplaced(const CityModel& city);

/// Removes the facets, and the buildings that have no others.
void leave_out(CityModel& city, const std::vector<MisplacedFacets>& misplaced);

/// Reports files whose buildings cannot be what they are meant to be, each once for the whole file, with what would explain it:
///   (1) implausible_size: buildings higher or larger than any on Earth, or a typical building smaller than 1 m
///   (2) lies_on_its_side: the ground rises as steeply as no town does, because another axis is the upward one
/// Coordinates are in metres, in any frame of the output CRS. Positions are as the city has them.
///
/// Returns why the city as a whole cannot be: nine of ten of its buildings and more are wider than 2 km and higher than any.
/// Mountains among the buildings of a town, bridges and meshes of whole towns are no reason.
[[nodiscard]] std::optional<std::string> report_implausible(const LocatedCity& located, Report& report);

}  // namespace farlod::georeference
