// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "base/grid.hpp"
#include "city/area.hpp"

namespace farlod::align {

/// The cells of a grid that an area meets.
struct AreaCells {
  std::vector<Cell> cells;                 ///< in the order of CellRange::index_of, each once
  std::size_t shapes_outside_of_grid = 0;  ///< points, lines and polygons that meet no cell
};

/// The area is in the city frame.
///   (1) a point meets the cell that holds it: on a border, the one to its east or north
///   (2) a line meets the cells that it runs through
///   (3) a polygon meets the cells that its rings run through, and those that it covers; a cell within a hole is not met
[[nodiscard]] AreaCells cells_met_by(const Area& area_city, const Grid& grid);

}  // namespace farlod::align
