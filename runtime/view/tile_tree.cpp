// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_tree.hpp"

#include <algorithm>
#include <cmath>

namespace farlod {
namespace {

/// The error of tiles that are one cell: less than what is seen of a wall. Those of larger tiles are its multiples.
constexpr double error_of_cells_m = 3.0;

}  // namespace

TileTree::TileTree(const ViewFrame& frame) : cells_(frame.cells), cell_edge_m_(frame.cell_edge_m) {
  const auto widest =
      static_cast<std::uint32_t>(std::max({1, frame.cells.i_end - frame.cells.i_begin, frame.cells.j_end - frame.cells.j_begin}));
  while ((1U << level_of_cells_) < widest) ++level_of_cells_;
}

TileTree TileTree::down_to_cells() const {
  TileTree tree = *this;
  tree.levels_within_cells_ = 0;
  return tree;
}

TileSquare TileTree::square_of(const TileAddress& tile) const {
  const double edge_m = std::ldexp(cell_edge_m_, static_cast<int>(level_of_cells_) - static_cast<int>(tile.level));
  return {{tile.x * edge_m, tile.y * edge_m}, edge_m};
}

bool TileTree::contains(const TileAddress& tile) const {
  if (tile.level >= levels() || tile.x >> tile.level != 0 || tile.y >> tile.level != 0) return false;
  const Point2d low = square_of(tile).low;
  return low.x < (cells_.i_end - cells_.i_begin) * cell_edge_m_ && low.y < (cells_.j_end - cells_.j_begin) * cell_edge_m_;
}

std::vector<TileAddress> TileTree::largest_tiles_from_the_middle(std::size_t most) const {
  const std::uint32_t level = first_level_with_content();
  const Point2d middle =
      0.5 * cell_edge_m_ *
      Point2d{static_cast<double>(cells_.i_end - cells_.i_begin), static_cast<double>(cells_.j_end - cells_.j_begin)};
  const auto distance = [&](const TileAddress& tile) {
    const auto [low, edge_m] = square_of(tile);
    return norm(low + 0.5 * Point2d{edge_m, edge_m} - middle);
  };
  std::vector<TileAddress> tiles;
  for (std::uint32_t y = 0; y < 1U << level; ++y)
    for (std::uint32_t x = 0; x < 1U << level; ++x)
      if (has_content({level, x, y})) tiles.push_back({level, x, y});
  std::ranges::stable_sort(tiles, {}, distance);
  tiles.resize(std::min(most, tiles.size()));
  return tiles;
}

CellRectangle TileTree::cells_of(const TileAddress& tile) const {
  const auto first_of = [&](std::uint32_t n) {
    return static_cast<std::int32_t>(tile.level >= level_of_cells_ ? n >> (tile.level - level_of_cells_)
                                                                   : n << (level_of_cells_ - tile.level));
  };
  const std::int32_t along = tile.level >= level_of_cells_ ? 1 : 1 << (level_of_cells_ - tile.level);
  const std::int32_t i = cells_.i_begin + first_of(tile.x), j = cells_.j_begin + first_of(tile.y);
  return {i, j, std::min(i + along, cells_.i_end), std::min(j + along, cells_.j_end)};
}

double TileTree::geometric_error_m(std::uint32_t level) const {
  return std::ldexp(error_of_cells_m, static_cast<int>(level_of_cells_) - static_cast<int>(level));
}

double TileTree::error_as_drawn_m(std::uint32_t level) const {
  const double error_m = geometric_error_m(level);
  return level >= first_level_with_content() ? error_m : std::max(error_m, square_of({level, 0, 0}).edge_m);
}

}  // namespace farlod
