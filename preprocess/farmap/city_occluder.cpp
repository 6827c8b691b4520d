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

Occluder occluder_of_tiles(const TileSet& tiles, const Grid& grid, Point2d origin_grid) {
  std::vector<PlacedMesh> placed;
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n)
    placed.push_back({tiles.tiles[n].mesh(), grid.corner_of(tiles.cells.cell_at(n)) - origin_grid});
  return occluder_of(placed);
}

}  // namespace

CityOccluder::CityOccluder(const TileSet& tiles, const Grid& grid)
    : tiles_(tiles),
      cells_(tiles.cells),
      origin_grid_(grid.middle_corner()),
      first_triangle_(first_triangles(tiles)),
      occluder_(occluder_of_tiles(tiles, grid, origin_grid_)) {}

std::size_t CityOccluder::tile_of(std::uint32_t triangle) const {
  // Empty tiles begin where the next one does: the last that begins at or before the triangle holds it
  const auto after = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), triangle);
  return static_cast<std::size_t>(after - first_triangle_.begin()) - 1;
}

Cell CityOccluder::cell_of_triangle(std::uint32_t triangle) const { return cells_.cell_at(tile_of(triangle)); }

const Surface& CityOccluder::surface_of(std::uint32_t triangle) const {
  const std::size_t n = tile_of(triangle);
  return tiles_.surfaces[tiles_.tiles[n].triangle_surfaces[triangle - first_triangle_[n]]];
}

}  // namespace farlod
