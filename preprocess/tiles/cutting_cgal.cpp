// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/cutting.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "tiles/exact_cutting_cgal.hpp"

namespace farlod {
namespace {

/// The one cell that holds the whole triangle, when there is one and no corner touches a border.
std::optional<Cell> only_cell(const std::array<Point3d, 3>& t, const Grid& grid) {
  const Cell low = grid.cell_of({std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y})});
  const Cell high = grid.cell_of({std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y})});
  return low == high ? std::optional(low) : std::nullopt;
}

Point3f rounded(const ExactCorner& corner, const std::array<Point3d, 3>& triangle, Cell cell, const Grid& grid,
                double height_origin_m) {
  if (corner.original >= 0)
    return cell_from_grid(triangle[static_cast<std::size_t>(corner.original)], cell, grid, height_origin_m);
  const Point2d south_west = grid.corner_of(cell);
  const auto round = [](const Rational& exact, double origin) {
    return static_cast<float>(CGAL::to_double(exact - Rational(origin)));
  };
  return {round(corner.p_grid.x, south_west.x), round(corner.p_grid.y, south_west.y), round(corner.p_grid.z, height_origin_m)};
}

std::vector<CellPiece> cut(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m,
                           const CellRange& wanted) {
  if (const auto cell = only_cell(triangle, grid)) {
    if (!wanted.contains(*cell)) return {};
    std::vector<Point3f> polygon;
    for (const Point3d& p : triangle) polygon.push_back(cell_from_grid(p, *cell, grid, height_origin_m));
    return {{*cell, std::move(polygon)}};
  }
  std::vector<CellPiece> pieces;
  for (const ExactPiece& exact : cut_exactly(triangle, grid, wanted)) {
    CellPiece& piece = pieces.emplace_back(CellPiece{exact.cell, {}});
    for (const ExactCorner& corner : exact.polygon)
      piece.polygon.push_back(rounded(corner, triangle, exact.cell, grid, height_origin_m));
  }
  return pieces;
}

}  // namespace

Point3f cell_from_grid(const Point3d& p_grid, Cell cell, const Grid& grid, double height_origin_m) {
  const Point2d corner = grid.corner_of(cell);
  return {static_cast<float>(p_grid.x - corner.x), static_cast<float>(p_grid.y - corner.y),
          static_cast<float>(p_grid.z - height_origin_m)};
}

std::vector<CellPiece> cut(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m) {
  return cut(triangle, grid, height_origin_m, all_cells);
}

std::vector<CellPiece> cut_within(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m) {
  return cut(triangle, grid, height_origin_m, grid.cells);
}

}  // namespace farlod
