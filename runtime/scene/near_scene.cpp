// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/near_scene.hpp"

#include "occlusion/placed_mesh.hpp"

namespace farlod {

Occluder near_scene(const PackageReader& package, Cell cell) {
  const Grid& grid = package.grid();
  const CellRange near = grid.neighborhood_of(cell).intersection(grid.cells);
  return occluder_of_cells(grid, near, grid.corner_of(cell), [&](Cell c) { return package.tile(c).mesh; });
}

}  // namespace farlod
