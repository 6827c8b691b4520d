// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "city/located_city.hpp"
#include "city/problem.hpp"

namespace farlod {

/// Height of the ground at a place of the city frame, where it is known.
using GroundHeight = std::function<std::optional<double>(Point2d p_city)>;

/// Puts buildings onto the ground: the lowest of it under their outline, so that nothing floats.
///   (1) what counts from the ground is lifted by it; where the ground is unknown, it stays
///   (2) of what reaches down to the ground the foot moves there; where the ground is unknown, above the roof, or so far below
///   it as no building is high, the building is left out and reported
///   (3) what has an elevation stays
void lift_onto_terrain(LocatedCity& located, const GroundHeight& ground_height, Report& report);

}  // namespace farlod
