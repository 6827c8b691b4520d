// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "city/located_city.hpp"
#include "farlod/problem.hpp"

namespace farlod::tiles {

/// Height of the ground at a place of the city frame, where it is known.
using KnownGroundHeightAt = std::function<std::optional<double>(Point2d p_city)>;

/// Moves buildings onto the ground: the lowest ground below their outlines, so that nothing floats. By HeightReference:
///   (1) on_ground: the building is lifted by the height of the ground; where that is unknown, the building does not move.
///   (2) down_to_ground: the base moves to the ground. Where the ground is unknown, above the roof, or farther below the roof
///       than any building is high, the building is left out and reported.
///   (3) elevation: the building does not move.
void lift_onto_terrain(LocatedCity& located, const KnownGroundHeightAt& ground_height, Report& report);

}  // namespace farlod::tiles
