// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// What a building's lowest points say of the ground.
enum class Base : std::uint8_t {
  on_ground,
  above_ground,  ///< it is a bridge, or a roof without walls
  below_ground   ///< its base is lower than the ground can be: an error in the file
};

/// What the base of each building is, told by its neighbors (docs/decisions/0004): the slope filter of Vosselman (2000), used
/// there to tell ground from objects in laser scans, for a ground that climbs by `steepest_ground` at the most.
///   (1) a bridge has neighbors on opposite sides whose bases are lower by `least_clearance_m`, or one that is lower than any
///   slope
///       between them explains
///   (2) below the ground is a base when more of its neighbors, and two at least, are higher than any slope explains than are on
///       its level, as far as a gentle slope goes
[[nodiscard]] std::vector<Base> bases_of(const CityModel& city);

/// The points where buildings meet the ground: of each building on the ground, its points within `base_thickness_m` of the
/// lowest.
[[nodiscard]] std::vector<Point3d> base_points(const CityModel& city, std::span<const Base> bases);

inline constexpr double base_thickness_m = 0.01;  ///< a slab drawn to the centimetre
inline constexpr double steepest_ground = 0.5;    ///< 27°: steeper streets are stairs
inline constexpr double gentle_ground = 0.2;      ///< 11°: streets seldom climb more
inline constexpr double least_clearance_m = 2.5;  ///< of something that one can walk under
inline constexpr double kerb_m = 1.5;             ///< steps, kerbs, plinths: bases differ by so much on level ground
inline constexpr double base_search_radius_m = 30.0;

}  // namespace farlod
