// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "tiles/grounded_walls.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod {

/// A building's lowest floor is what lies within this above its lowest point: floors of half a step less are one.
inline constexpr double lowest_floor_thickness_m = 0.5;

/// A floor that is so much above the ground is more likely at the wrong height than on a foundation.
inline constexpr double storey_m = 3.0;

/// How far the borders are above the ground, at the most.
[[nodiscard]] double largest_gap_m(std::span<const HorizonSegment> foot, const GroundHeightAt& ground_height);

/// What is missing between the borders of a building's lowest floor and the ground below them: upright triangles, grid frame.
/// They end a little below the ground. `foot` are parts of lower borders that are above the ground.
[[nodiscard]] std::vector<std::array<Point3d, 3>> foundation_walls(std::span<const HorizonSegment> foot,
                                                                   const GroundHeightAt& ground_height);

}  // namespace farlod
