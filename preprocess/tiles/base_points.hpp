// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The points where buildings meet the ground: for each building, its points within `base_thickness_m` of the lowest.
///
/// A bridge between two houses does not stand on the ground, although it has a lowest point too. A building is taken for
/// hanging when another one nearby has its base lower by more than a slope of `steepest_ground` over their distance, plus
/// `least_clearance_m` (the slope filter of Vosselman 2000, used there to tell ground from objects in laser scans).
[[nodiscard]] std::vector<Point3d> base_points(const CityModel& city);

inline constexpr double base_thickness_m = 0.01;  ///< a slab drawn to the centimetre
inline constexpr double steepest_ground = 0.5;    ///< 27°: steeper streets are stairs
inline constexpr double least_clearance_m = 1.5;  ///< of something that one can walk under, less the kerb and the step
inline constexpr double base_search_radius_m = 30.0;

}  // namespace farlod
