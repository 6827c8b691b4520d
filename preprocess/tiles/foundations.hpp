// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "tiles/ground.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/slab.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {

/// The lowest floor of a building is all that lies within this height above its lowest point. Two floors that differ by less
/// count as one.
inline constexpr double lowest_floor_thickness_m = 0.5;

/// A gap of more than a storey is reported: the height of the floor is more likely wrong than the foundation that high.
inline constexpr double storey_m = 3.0;

/// What closes the gap between the lowest floor of a building and the ground below it.
struct Foundation {
  double top_m = 0.0;  ///< upper end of the lowest floor: below it the building counts as closed
  double gap_m = 0.0;  ///< largest height of the floor's borders above the ground
  Point3d place;       ///< an end of one of these borders
  std::vector<std::array<Point3d, 3>> walls;
};

/// Finds the foundation of a building whose base is on the ground, or below it. `undersides` are the parts of its lower borders
/// that are above the ground; the borders of the lowest floor are taken out of them when there is a foundation.
/// There is none, but for a building that the file says to reach down to the ground,
///   (1) when the building has a clearance on all sides: it is a roof without walls, or a bridge without neighbors
///   (2) when no border of its lowest floor is above the ground
///   (3) when the gap is higher than the building: it is a bridge from bank to bank
[[nodiscard]] std::optional<Foundation> take_foundation(std::span<const Point3d> building_points, Foot foot,
                                                        std::vector<HorizonSegment>& undersides,
                                                        const GroundHeightAt& ground_height);

/// Vertical triangles from the borders of the lowest floor down to the ground, in the grid frame. They end a little below the
/// ground. `foot` are the parts of lower borders that are above the ground.
[[nodiscard]] std::vector<std::array<Point3d, 3>> foundation_walls(std::span<const HorizonSegment> foot,
                                                                   const GroundHeightAt& ground_height);

/// A floor of a building, other than its lowest one, below which nobody can stand somewhere: slabs that look down and share
/// edges.
struct LowFloor {
  double least_gap_m = 0.0, largest_gap_m = 0.0;  ///< of its borders above the ground
  Point3d place;                                  ///< an end of one of these borders
  std::vector<std::array<Point3d, 3>> walls;      ///< from these borders down to the ground; none if it is left open
  std::vector<std::array<Point3d, 3>> lid;        ///< its slabs
};

/// Finds the low floors of a building whose base is on the ground. A floor is closed
///   (1) if nobody can stand below its borders: their mean height above the ground is less than `least_clearance_m`, and nowhere
///       more than `storey_m`
///   (2) if there is more building above it than air below it: balconies, landings and eaves are thinner
///   (3) if it is wider than its borders are high: below a bay, or into a niche, the sky looks from the side
///   (4) if nothing but air is between it and the ground: above a sill one sees what lies behind the window, and the floor of a
///       dormer lies in the house.
/// The borders of closed floors are taken out of `undersides`, and their slabs stand `on_ground`. A floor for which (1) alone
/// fails is among the result without walls.
[[nodiscard]] std::vector<LowFloor> take_low_floors(std::span<Slab> slabs, std::vector<HorizonSegment>& undersides,
                                                    const GroundHeightAt& ground_height);

/// Adds the walls below a floor to those of its building.
void add_wall_profiles(const LowFloor& floor, std::vector<WallProfile>& walls);

/// What the report says of floors in the air, with positions in the grid frame.
[[nodiscard]] Problem floor_in_the_air(const Building& building, const Foundation& foundation);
[[nodiscard]] Problem floor_in_the_air(const Building& building, const LowFloor& floor);

/// What it says of a building more than half of whose height is below the ground at each of its corners, by more than
/// `ground_contact_m`. It stands at the highest.
[[nodiscard]] std::optional<Problem> below_ground(const Building& building, std::span<const Point3d> building_points,
                                                  const GroundHeightAt& ground_height);

}  // namespace farlod::tiles
