// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/city_occluder.hpp"

#include <algorithm>

#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

std::vector<std::uint32_t> first_triangles(const TileSet& tiles) {
  std::vector<std::uint32_t> first;
  std::uint32_t next = 0;
  for (const Tile& tile : tiles.tiles) {
    first.push_back(next);
    next += static_cast<std::uint32_t>(tile.triangles.size());
  }
  return first;
}

}  // namespace

CityOccluder::CityOccluder(const TileSet& tiles, const Grid& grid)
    : cells_(tiles.cells),
      origin_grid_(grid.middle_corner()),
      first_triangle_(first_triangles(tiles)),
      occluder_(occluder_of_cells(grid, cells_, origin_grid_, [&](Cell c) { return tiles.tile(c).mesh(); })) {}

Cell CityOccluder::cell_of_triangle(std::uint32_t triangle) const {
  // Empty tiles begin where the next one does: the last that begins at or before the triangle holds it
  const auto after = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), triangle);
  return cells_.cell_at(static_cast<std::size_t>(after - first_triangle_.begin()) - 1);
}

}  // namespace farlod
