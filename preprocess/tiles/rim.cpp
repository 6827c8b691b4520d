// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/rim.hpp"

#include <cstddef>

namespace farlod::tiles {

bool lies_on_rim(const CellEdge& edge, const Grid& grid) {
  const auto edge_m = static_cast<float>(grid.cell_edge_m);
  const Point3f &a = edge.edge.a, &b = edge.edge.b;
  return (edge.cell.i == grid.cells.i_begin && a.x == 0.0F && b.x == 0.0F) ||
         (edge.cell.j == grid.cells.j_begin && a.y == 0.0F && b.y == 0.0F) ||
         (edge.cell.i == grid.cells.i_end - 1 && a.x == edge_m && b.x == edge_m) ||
         (edge.cell.j == grid.cells.j_end - 1 && a.y == edge_m && b.y == edge_m);
}

std::vector<CellEdge> rim_of(const CellPiece& piece, const Grid& grid) {
  std::vector<CellEdge> rim;
  for (std::size_t k = 0; k < piece.polygon.size(); ++k) {
    const CellEdge side{piece.cell, {piece.polygon[k], piece.polygon[(k + 1) % piece.polygon.size()], {}}};
    if (lies_on_rim(side, grid)) rim.push_back(side);
  }
  return rim;
}

}  // namespace farlod::tiles
