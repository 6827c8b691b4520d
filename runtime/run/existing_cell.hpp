// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/grid.hpp"
#include "farlod/error.hpp"
#include "farlod/inspection.hpp"

namespace farlod {

/// The cell that a caller names. Throws InvalidArgument where the grid has no such cell.
[[nodiscard]] inline Cell existing_cell(const Grid& grid, CellPlace place) {
  const Cell cell{place.i, place.j};
  const CellRange& all = grid.cells;
  if (all.contains(cell)) return cell;
  throw InvalidArgument("there is no cell " + std::to_string(place.i) + "," + std::to_string(place.j) + ": i goes from " +
                        std::to_string(all.i_begin) + " to " + std::to_string(all.i_end - 1) + ", j from " +
                        std::to_string(all.j_begin) + " to " + std::to_string(all.j_end - 1));
}

}  // namespace farlod
