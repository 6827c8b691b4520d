// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tiles/building_pieces.hpp"
#include "tiles/ground.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

/// The upper borders of a building that has open lower borders, each with its role. Left out are those that no eye outside of the
/// building's solids sees as a horizon: inside of it, or right below one that is grounded. Proof in docs/concepts.md, "What is
/// grounded, and what overhangs". The building loses its walls and slabs.
[[nodiscard]] std::vector<HorizonSegment> upper_borders_with_roles(BuildingPieces& building, const GroundHeightAt& ground_height);

}  // namespace farlod::tiles
