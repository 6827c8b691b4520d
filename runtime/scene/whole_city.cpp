// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/whole_city.hpp"

#include <vector>

#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

Occluder occluder_of_tiles(const Package& package, Point2d origin_grid) {
  const Grid& grid = package.grid();
  std::vector<PlacedMesh> placed;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    const Cell cell = grid.cells.cell_at(n);
    placed.push_back({package.tile(cell).mesh, grid.corner_of(cell) - origin_grid});
  }
  return occluder_of(placed);
}

}  // namespace

WholeCity::WholeCity(const Package& package)
    : grid_(package.grid()), origin_grid_(grid_.middle_corner()), occluder_(occluder_of_tiles(package, origin_grid_)) {}

Point3f WholeCity::scene_from_cell(const Point3f& p_cell, Cell cell) const {
  const Point2d shift = grid_.corner_of(cell) - origin_grid_;
  return {static_cast<float>(p_cell.x + shift.x), static_cast<float>(p_cell.y + shift.y), p_cell.z};
}

}  // namespace farlod
