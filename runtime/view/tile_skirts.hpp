// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "view/tile_surfaces.hpp"
#include "view/tile_tree.hpp"

namespace farlod {

/// Leads facets that look up and end at the border of a tile on below those of the neighboring tile, outwards and down alike.
/// Neighbors differ there by their rounding or, where they are simplified, in their heights, and the background would be seen
/// between them as white dots. The new facets have the value and the feature of the one that they go on from.
///   (1) the facets that were there stay as they are, and come first
///   (2) at the border of the grid, where no neighbor is, there are no new ones
void add_skirts(const ViewFrame& frame, const TileTree& tree, const TileAddress& tile, TileSurfaces& surfaces,
                std::vector<float>& values);

}  // namespace farlod
