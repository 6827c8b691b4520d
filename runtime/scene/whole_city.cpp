// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/whole_city.hpp"

#include "occlusion/placed_mesh.hpp"

namespace farlod {

WholeCity::WholeCity(const PackageReader& package, const std::stop_token& stop)
    : grid_(package.grid()),
      origin_grid_(grid_.middle_corner()),
      occluder_(occluder_of_cells(
          grid_, grid_.cells, origin_grid_, [&](Cell c) { return package.tile(c).mesh; }, stop)) {}

Point3f WholeCity::scene_from_cell(const Point3f& p_cell, Cell cell) const { return placed(p_cell, scene_from_cell_m(cell)); }

}  // namespace farlod
