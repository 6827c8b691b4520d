// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/paging/paged_array.hpp"
#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles {

/// Whether the base of a building, its lowest points, lies on the ground.
enum class Base : std::uint8_t {
  on_ground,
  above_ground,  ///< a bridge, or a roof without walls
  below_ground   ///< lower than the ground can be: an error in the file
};

/// Classifies the base of each building by those of its neighbors (docs/decisions/0004). The test is the slope filter of
/// Vosselman (2000), which separates ground from objects in laser scans, for a ground whose slope is at most `steepest_ground`.
///   (1) A base is above the ground when neighbors on opposite sides have lower bases, by more than `least_clearance_m` plus the
///       slope, or when one neighbor is lower than any slope between the two allows.
///   (2) A base is below the ground when at least two neighbors are higher than any slope allows, and more of them than neighbors
///       whose bases agree with it up to a gentle slope.
[[nodiscard]] std::vector<Base> bases_of(const CityModel& city);

/// The points at which buildings meet the ground: the points of each building on the ground that are at most `base_thickness_m`
/// above its lowest point. Each once for each building.
[[nodiscard]] PagedArray<Point3d> base_points(const CityModel& city, std::span<const Base> bases);

inline constexpr double base_thickness_m = 0.01;  ///< bases are drawn to the centimetre
inline constexpr double steepest_ground = 0.5;    ///< 27°: steeper streets are stairs
inline constexpr double gentle_ground = 0.2;      ///< 11°: streets are seldom steeper
inline constexpr double least_clearance_m = 2.5;  ///< height under which a person can walk
inline constexpr double kerb_m = 1.5;             ///< steps, kerbs and plinths: difference of bases on level ground
inline constexpr double base_search_radius_m = 30.0;

}  // namespace farlod::tiles
