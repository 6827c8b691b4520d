// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/tile_surfaces.hpp"

namespace farlod {

/// Simplifies what is drawn of a tile: vertices near each other become one, and facets that are a line or a point then are left
/// out, and so are facets that cover one another. Ground and buildings do not share vertices.
///   (1) no vertex moves by more than `error_m`
///   (2) one on the border of the square stays on it, and moves as the neighboring tile's does, but for its height
void move_into_clusters(const ViewFrame& frame, const TileSquare& square, double error_m, TileSurfaces& surfaces);

}  // namespace farlod
