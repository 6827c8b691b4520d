// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "base/paging/paged_array.hpp"
#include "city/city_model.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "plausibility/standing_heights.hpp"
#include "tiles/ground.hpp"

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
///   (3) Buildings that the file says to begin above the ground do, and are nobody's neighbors.
///   (4) Where most of a town (of 20 buildings at least) would be above or below the ground, all but (3) are on it: it is
///   steeper.
[[nodiscard]] std::vector<Base> bases_of(const CityModel& city);

/// The bases where the ground is surveyed: all are on it, but for (3).
[[nodiscard]] std::vector<Base> bases_on_survey(const CityModel& city);

/// The points at which buildings meet the ground: the points of each building on the ground that are at most `base_thickness_m`
/// above its lowest point. Each once for each building.
[[nodiscard]] PagedArray<Point3d> base_points(const CityModel& city, std::span<const Base> bases);

inline constexpr double least_clearance_m = 2.5;  ///< height under which a person can walk
inline constexpr double base_search_radius_m = 30.0;

/// Selects the points of a relief that shape the ground of a rectangle. Reliefs come in tiles that are far larger than a city.
///   (1) All points within a distance of L of the rectangle are kept, where L is the longer side of the rectangle.
///   (2) Between L and 2L one point is kept for each square of side L/4, between 2L and 4L one for each square of side L/2, and
///       so on. A coarse relief keeps all its points, and a fine one keeps enough of them.
///   (3) The result is sorted by place, and does not depend on the order of the points.
[[nodiscard]] std::vector<Point3d> thinned_relief(std::vector<Point3d> points_grid, const Box2d& rectangle);

/// The ground through the nodes of a raster, or through the points of a relief; nothing when there is neither.
[[nodiscard]] std::optional<Ground> surveyed_ground(const std::optional<TerrainRaster>& terrain,
                                                    std::span<const Point3d> relief_points_city, const Grid& grid,
                                                    GroundExtent extent);

/// Moves buildings onto the ground: the lowest ground below their outlines, so that nothing floats. By HeightReference:
///   (1) on_ground: the building is lifted by the height of the ground; where that is unknown, the building does not move.
///   (2) down_to_ground: the base moves to the ground. Where the ground is unknown, above the roof, or farther below the roof
///       than any building is high, the building is left out and reported.
///   (3) elevation: the building does not move.
void lift_onto_terrain(LocatedCity& located, const plausibility::KnownGroundHeightAt& ground_height, Report& report);

}  // namespace farlod::tiles
