// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/near_scene.hpp"

#include <vector>

#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

std::vector<PlacedMesh> near_tiles(const Package& package, Cell cell) {
  const Grid& grid = package.grid();
  const CellRange near = grid.neighborhood_of(cell).intersection(grid.cells);
  std::vector<PlacedMesh> placed;
  for (std::size_t n = 0; n < static_cast<std::size_t>(near.size()); ++n) {
    const Cell neighbor = near.cell_at(n);
    placed.push_back({package.tile(neighbor).mesh, grid.corner_of(neighbor) - grid.corner_of(cell)});
  }
  return placed;
}

}  // namespace

Occluder near_scene(const Package& package, Cell cell) { return occluder_of(near_tiles(package, cell)); }

}  // namespace farlod
