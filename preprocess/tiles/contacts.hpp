// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "package/horizon_edge.hpp"
#include "package/tile_set.hpp"

namespace farlod::tiles {

/// A triangle touches an edge when it is nearer than this: walls end on roofs, and balconies at walls, with gaps of about a
/// centimetre.
inline constexpr double contact_m = 0.02;

/// The parts of a lower border that stay open: no triangle of the tile, of any building, touches the border there and continues
/// below it. The border and the tile are in the frame of the same cell.
[[nodiscard]] std::vector<HorizonEdge> without_contacts(const HorizonEdge& edge, const Tile& tile);

}  // namespace farlod::tiles
