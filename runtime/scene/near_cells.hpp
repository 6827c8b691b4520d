// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/grid.hpp"

namespace farlod {

/// The cells whose geometry is near for receivers of a cell: its neighborhood. Outside of the grid, where there are no far maps,
/// all of the city is near.
[[nodiscard]] inline CellRange near_cells_of(const Grid& grid, Cell cell) {
  return grid.cells.contains(cell) ? grid.neighborhood_of(cell).intersection(grid.cells) : grid.cells;
}

}  // namespace farlod
