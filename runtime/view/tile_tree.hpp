// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "view/view_frame.hpp"

namespace farlod {

/// A tile of a quadtree: x counts along the grid's x axis, y along its y axis, both from the first cell's corner; the level is 0
/// of the root.
struct TileAddress {
  std::uint32_t level = 0, x = 0, y = 0;
  auto operator<=>(const TileAddress&) const = default;
};

/// A square of the grid frame, in metres from the first cell's corner: half open, as cells are.
struct TileSquare {
  Point2d low;
  double edge_m = 0.0;

  [[nodiscard]] bool contains(Point2d p) const {
    return low.x <= p.x && p.x < low.x + edge_m && low.y <= p.y && p.y < low.y + edge_m;
  }
};

/// The quadtree over the cells of a city, as 3D Tiles 1.1 divides space implicitly: the tiles of one level are the cells, those
/// below it halves and quarters of cells, those above it squares of 2 × 2, 4 × 4 … cells.
///   (1) the error of a tile is twice that of its children
///   (2) tiles with content cover all cells at each level that has content
class TileTree {
 public:
  explicit TileTree(const ViewFrame& frame);

  [[nodiscard]] std::uint32_t level_of_cells() const { return level_of_cells_; }
  /// Levels, of which the last is levels() − 1.
  [[nodiscard]] std::uint32_t levels() const { return level_of_cells_ + 1 + levels_within_cells_; }
  /// Tiles of more cells than 8 × 8, in a city of more than 32 × 32 than 16 × 16, have children, and no content of their own: it
  /// would be a whole city's. Coarser tiles than those would be seen from the first view, which has the whole city.
  [[nodiscard]] std::uint32_t first_level_with_content() const {
    const std::uint32_t coarser = level_of_cells_ > 5 ? 4 : 3;
    return level_of_cells_ > coarser ? level_of_cells_ - coarser : 0;
  }
  /// Tiles of that level, those nearest to the middle of the grid first.
  [[nodiscard]] std::vector<TileAddress> largest_tiles_from_the_middle(std::size_t most) const;
  /// The same tree without the levels below that of cells.
  [[nodiscard]] TileTree down_to_cells() const;
  /// Whether the tile is in the tree and meets a cell.
  [[nodiscard]] bool contains(const TileAddress& tile) const;
  [[nodiscard]] bool has_content(const TileAddress& tile) const {
    return tile.level >= first_level_with_content() && contains(tile);
  }
  [[nodiscard]] TileSquare square_of(const TileAddress& tile) const;
  /// The cells that the tile meets; it must be in the tree.
  [[nodiscard]] CellRectangle cells_of(const TileAddress& tile) const;
  /// In metres: by how much the content of a tile of this level is off, where its children's is right.
  [[nodiscard]] double geometric_error_m(std::uint32_t level) const;
  /// In metres: by how much a picture is off that ends at tiles of this level. Where they have no content, a whole tile is
  /// missing.
  [[nodiscard]] double error_as_drawn_m(std::uint32_t level) const;

 private:
  CellRectangle cells_;
  double cell_edge_m_;
  std::uint32_t level_of_cells_ = 0, levels_within_cells_ = 2;
};

/// The levels of one file of a subtree.
inline constexpr std::uint32_t levels_of_subtree = 6;

/// tileset.json: the root's box and error, the class of the tiles' metadata, and where subtrees and contents are
/// (subtrees/LEVEL.X.Y.subtree, tiles/LEVEL/X/Y.glb). `ecef_from_local` is the root's transform, column by column.
[[nodiscard]] std::string tileset_json(const ViewFrame& frame, const TileTree& tree,
                                       const std::array<double, 16>& ecef_from_local);

/// The binary subtree whose root is this tile: which tiles there are, and which of them have content and subtrees below them.
/// Where there may be tiles without content, it has the errors of its tiles as drawn: Cesium draws nothing in the place of a tile
/// whose error is small enough, and that of its level would be.
[[nodiscard]] std::string subtree_file(const TileTree& tree, const TileAddress& root);

}  // namespace farlod
