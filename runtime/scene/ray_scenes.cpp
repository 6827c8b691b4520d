// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ray_scenes.hpp"

#include <utility>

#include "scene/canopy_around.hpp"

namespace farlod {

Occluder near_scene(const PackageReader& package, Cell cell) {
  const Grid& grid = package.grid();
  const CellRange near = grid.neighborhood_of(cell).intersection(grid.cells);
  return occluder_of_cells(grid, near, grid.corner_of(cell), [&](Cell c) { return package.tile(c).mesh; });
}

WholeCity::WholeCity(const PackageReader& package, const std::stop_token& stop)
    : grid_(package.grid()),
      origin_grid_(grid_.middle_corner()),
      occluder_(occluder_of_cells(
          grid_, grid_.cells, origin_grid_, [&](Cell c) { return package.tile(c).mesh; }, stop, package.far_terrain())) {}

Point3f WholeCity::scene_from_cell(const Point3f& p_cell, Cell cell) const { return placed(p_cell, scene_from_cell_m(cell)); }

WholeCityOnDemand::WholeCityOnDemand(const PackageReader& package, std::stop_token stop)
    : package_(package), stop_(std::move(stop)) {}

const WholeCity& WholeCityOnDemand::city() const {
  std::call_once(has_city_, [&] { city_.emplace(package_, stop_); });
  return *city_;
}

const CrownOccluder& WholeCityOnDemand::crowns(const CanopySettings& settings) const {
  std::call_once(has_crowns_, [&] {
    const Grid& grid = package_.grid();
    crowns_.emplace(crowns_of_whole_city(package_, grid.cell_of(grid.middle_corner())), settings, stop_);
  });
  return *crowns_;
}

}  // namespace farlod
