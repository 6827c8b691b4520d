// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "farlod/horizon/horizon_edge.hpp"
#include "tiles/tile_set.hpp"

namespace farlod {

/// What touches an edge to this goes on there: walls that end on a roof, balconies that end at a wall.
inline constexpr double contact_m = 0.02;

/// The parts of a lower border that nothing closes: along all others, facets of the tile touch it, of whatever building, that go
/// on below. The border and the tile are in the frame of the same cell.
[[nodiscard]] std::vector<HorizonEdge> without_contacts(const HorizonEdge& underside, const Tile& tile);

}  // namespace farlod
