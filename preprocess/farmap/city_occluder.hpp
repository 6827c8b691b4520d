// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.hpp"
#include "occlusion/occluder.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// All tiles as one occluder. Its frame is the grid frame, moved to the corner of the middle cell so that floats are finest
/// in the city, with heights as in the tiles.
class CityOccluder {
 public:
  CityOccluder(const TileSet& tiles, const Grid& grid);

  [[nodiscard]] const Occluder& occluder() const { return occluder_; }
  [[nodiscard]] Point3f frame_from_grid(Point2d p_grid, float height_m) const {
    return {static_cast<float>(p_grid.x - origin_grid_.x), static_cast<float>(p_grid.y - origin_grid_.y), height_m};
  }
  /// The cell whose tile holds a triangle of the occluder.
  [[nodiscard]] Cell cell_of_triangle(std::uint32_t triangle) const;

 private:
  CellRange cells_;
  Point2d origin_grid_;
  std::vector<std::uint32_t> first_triangle_;  ///< of each tile
  Occluder occluder_;
};

}  // namespace farlod
