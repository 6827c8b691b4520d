// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "base/paging/paged_array.hpp"
#include "farlod/box.hpp"
#include "package/horizon_edge.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// An edge of the far city that can be a silhouette, in the frame of CityHorizon.
struct OccluderEdge {
  Point3d a, b;
  AdjacentSlopes adjacent = {};
  EdgeRole role = EdgeRole::grounded;

  [[nodiscard]] bool is_upper() const { return role != EdgeRole::underside; }
  [[nodiscard]] double z_high_m() const { return std::max(a.z, b.z); }
  /// In a frame whose origin is moved.
  [[nodiscard]] OccluderEdge from(Point2d origin) const {
    const Point3d shift{origin.x, origin.y, 0.0};
    return {a - shift, b - shift, adjacent, role};
  }
};

/// All occluders of a city, and of the far terrain around it, below a tree of boxes (a bounding volume hierarchy), so that whole
/// subtrees can be culled. Its upper part divides the cells; what stands in a cell is divided further, so that the nearer part of
/// it can hide the farther. Those of a large city lie on disk (PagedArray): a cell looks at the tree, and at the occluders around
/// it. Frame: the grid frame moved to the corner of the middle cell, with heights as in the tiles.
class CityHorizon {
 public:
  struct Node;

  CityHorizon(const TileSet& tiles, const Grid& grid);
  /// One that was made before, of its occluders and its nodes.
  CityHorizon(const Grid& grid, PagedArray<OccluderEdge> occluders, PagedArray<Node> nodes);

  /// A box around everything in a rectangle of cells, or around some of what is in a cell; its children divide it.
  struct Node {
    Box2d outline;
    double z_high_m = 0.0;
    double z_underside_m = 0.0;  ///< of the highest underside; less than any height where there is none
    Cell cell;                   ///< of a leaf; some have the same, and all of the far terrain have `beyond_grid`
    std::uint32_t children = 0;  ///< index of the first of two; 0 for a leaf
    std::uint32_t first_occluder = 0, occluder_count = 0;
  };
  /// The root is the first, unless the city is empty.
  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  [[nodiscard]] std::span<const OccluderEdge> occluders() const { return occluders_; }
  [[nodiscard]] bool has_far_terrain() const { return nodes_.size() > 2 && nodes_[2].cell == beyond_grid; }
  /// Whether the occluder of a number is of the far terrain.
  [[nodiscard]] bool is_far_terrain(std::uint32_t number) const {
    return has_far_terrain() && number >= nodes_[2].first_occluder;
  }
  /// Gives back the memory of both, as far as they lie on disk.
  void let_go() const;
  [[nodiscard]] Point2d corner_of(Cell cell) const { return grid_.corner_of(cell) - origin_grid_; }

 private:
  void gather(const Tile& tile, Cell cell);
  void add_beyond(const FarTerrain& far_terrain);
  void build(std::uint32_t node, const CellRange& range);
  void build_in_cell(std::uint32_t node, Cell cell, std::uint32_t first, std::uint32_t count);
  [[nodiscard]] Node leaf_of(Cell cell, std::uint32_t first, std::uint32_t count) const;
  void join_children(std::uint32_t node);

  const Grid& grid_;
  Point2d origin_grid_;
  CellRange cells_;
  PagedArray<OccluderEdge> occluders_;
  std::vector<std::uint32_t> first_of_cell_;  ///< one more than there are cells
  PagedArray<Node> nodes_;
};

}  // namespace farlod
