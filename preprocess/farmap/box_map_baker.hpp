// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "base/grid.hpp"
#include "farmap/city_occluder.hpp"
#include "farmap/far_height_bound.hpp"
#include "farmap/far_map_settings.hpp"
#include "package/baked_block.hpp"
#include "package/tile_set.hpp"
#include "tiles/tiles.hpp"

namespace farlod {

/// Captures the far maps of a block's cells, in the order of CellRange::index_of: what the city outside of each cell's
/// neighborhood hides, one ray a texel from the cell's centre (paper, Section 3; on a box that has no lid instead of a cube).
class BoxMapBaker {
 public:
  /// The tiles and the grid must outlive the baker.
  BoxMapBaker(const TileSet& tiles, const Grid& grid, Assign assign, const BoxMapSettings& settings)
      : tiles_(tiles), grid_(grid), assign_(assign), settings_(settings), city_(tiles, grid), height_bound_(tiles, grid) {}

  [[nodiscard]] BakedBoxes bake(Block block, const std::stop_token& stop = {}) const;
  /// The far maps of these cells, in their order.
  [[nodiscard]] BakedBoxes bake(std::span<const Cell> cells, const std::stop_token& stop = {}) const;

 private:
  [[nodiscard]] BakedBox bake_cell(Cell cell) const;
  [[nodiscard]] float distance_m(const Point3f& capture, const Point3d& direction, const CellRange& near) const;

  const TileSet& tiles_;
  const Grid& grid_;
  Assign assign_;
  BoxMapSettings settings_;
  CityOccluder city_;
  FarHeightBound height_bound_;
};

}  // namespace farlod
