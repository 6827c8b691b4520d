// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/surveyed_ground.hpp"

#include <utility>
#include <vector>

#include "tiles/relief_thinning.hpp"

namespace farlod::tiles {
namespace {

PagedArray<Point3d> nodes_of(const TerrainRaster& terrain, const GridRotation& rotation) {
  PagedArray<Point3d> nodes;
  for (std::size_t row = 0; row < terrain.rows; ++row)
    for (std::size_t column = 0; column < terrain.columns; ++column)
      if (const auto& height = terrain.height_m[row * terrain.columns + column]) {
        const Point2d p_grid = rotation.grid_from_city(terrain.node(column, row));
        nodes.push_back({p_grid.x, p_grid.y, *height});
      }
  return nodes;
}

}  // namespace

std::optional<Ground> surveyed_ground(const std::optional<TerrainRaster>& terrain, std::span<const Point3d> relief_points_city,
                                      const Grid& grid, GroundExtent extent) {
  if (terrain) return Ground(nodes_of(*terrain, grid.rotation), grid.rectangle(), extent);
  if (relief_points_city.empty()) return std::nullopt;
  std::vector<Point3d> points_grid;
  points_grid.reserve(relief_points_city.size());
  for (const Point3d& p_city : relief_points_city) points_grid.push_back(grid.rotation.grid_from_city(p_city));
  PagedArray<Point3d> kept = thinned_relief(std::move(points_grid), grid.rectangle());
  return Ground(std::move(kept), grid.rectangle(), extent);
}

}  // namespace farlod::tiles
