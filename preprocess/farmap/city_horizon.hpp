// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/grid.hpp"
#include "farlod/horizon/horizon_edge.hpp"
#include "tiles/tile_set.hpp"

namespace farlod {

/// A thing of the far city that can hide the sky, in the frame of CityHorizon: an edge with all that is below it, or a triangle
/// by itself.
struct Obstacle {
  std::array<Point3d, 3> corners;  ///< of an edge, the third repeats the second
  bool is_edge = true;
  EdgeRises rises = {};  ///< of an edge

  [[nodiscard]] double z_high_m() const { return std::max({corners[0].z, corners[1].z, corners[2].z}); }
  [[nodiscard]] std::uint32_t edge_count() const { return is_edge ? 1 : 3; }
  /// The corners in a frame whose origin is moved.
  [[nodiscard]] std::array<Point3d, 3> corners_from(Point2d origin) const {
    const Point3d shift{origin.x, origin.y, 0.0};
    return {corners[0] - shift, corners[1] - shift, corners[2] - shift};
  }
};

/// All obstacles of a city, by cell, with a tree of boxes above them so that whole quarters can be told to be hidden at once.
/// Frame: the grid frame moved to the corner of the middle cell, with heights as in the tiles.
class CityHorizon {
 public:
  CityHorizon(const TileSet& tiles, const Grid& grid);

  /// A box around everything in a rectangle of cells; its children divide the rectangle.
  struct Node {
    Box2d outline;
    double z_high_m = 0.0;
    Cell cell;                   ///< of a leaf
    std::uint32_t children = 0;  ///< place of the first of two; 0 for a leaf
    std::uint32_t first_obstacle = 0, obstacle_count = 0;
  };
  /// The root is the first, unless the city is empty.
  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  [[nodiscard]] std::span<const Obstacle> obstacles() const { return obstacles_; }
  [[nodiscard]] Point2d corner_of(Cell cell) const { return grid_.corner_of(cell) - origin_grid_; }

 private:
  void gather(const Tile& tile, const std::vector<Surface>& surfaces, Cell cell);
  void build(std::uint32_t node, const CellRange& range);

  const Grid& grid_;
  Point2d origin_grid_;
  CellRange cells_;
  std::vector<Obstacle> obstacles_;
  std::vector<std::uint32_t> first_of_cell_;  ///< one more than there are cells
  std::vector<Node> nodes_;
};

}  // namespace farlod
