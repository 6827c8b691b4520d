// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "tiles/ground.hpp"
#include "tiles/horizon_edges.hpp"

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
/// There is none
///   (1) when the building has a clearance on all sides: it is a roof without walls, or a bridge without neighbors
///   (2) when no border of its lowest floor is above the ground
///   (3) when the gap is higher than the building: it is a bridge from bank to bank
[[nodiscard]] std::optional<Foundation> take_foundation(std::span<const Point3d> building_points,
                                                        std::vector<HorizonSegment>& undersides,
                                                        const GroundHeightAt& ground_height);

/// Vertical triangles from the borders of the lowest floor down to the ground, in the grid frame. They end a little below the
/// ground. `foot` are the parts of lower borders that are above the ground.
[[nodiscard]] std::vector<std::array<Point3d, 3>> foundation_walls(std::span<const HorizonSegment> foot,
                                                                   const GroundHeightAt& ground_height);

}  // namespace farlod::tiles
