// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "base/grid.hpp"
#include "tiles/cutting.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

/// Whether an edge lies on the outer border of the grid, whose cell it belongs to.
[[nodiscard]] bool lies_on_rim(const CellEdge& edge, const Grid& grid);

/// The sides of a piece of the ground along the outer border of the grid: where it is cut, it ends.
[[nodiscard]] std::vector<CellEdge> rim_of(const CellPiece& piece, const Grid& grid);

}  // namespace farlod::tiles
