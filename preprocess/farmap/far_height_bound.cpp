// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/far_height_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farlod {
namespace {

/// Buildings that are assigned whole may lean into the capture point itself; a map this tall (85°) is tall enough.
constexpr double tallest_top = 11.43;

}  // namespace

FarHeightBound::FarHeightBound(const TileSet& tiles, const Grid& grid) : grid_(grid), cells_(tiles.cells) {
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    const Point2d corner = grid.corner_of(cells_.cell_at(n));
    Prism prism{{}, tiles.tiles[n].z_high_m};
    for (const Point3f& p : tiles.tiles[n].vertices) prism.outline_grid.add(corner + Point2d{p.x, p.y});
    tiles_.push_back(prism);
  }
  for (const Block block : grid.blocks()) {
    BlockPrism b{{{}, -std::numeric_limits<float>::infinity()}, grid.cells_of(block)};
    for (std::size_t n = 0; n < static_cast<std::size_t>(b.cells.size()); ++n) {
      const Prism& tile = tiles_[cells_.index_of(b.cells.cell_at(n))];
      if (tile.outline_grid.empty()) continue;
      b.prism.height_m = std::max(b.prism.height_m, tile.height_m);
      b.prism.outline_grid.add(tile.outline_grid.low);
      b.prism.outline_grid.add(tile.outline_grid.high);
    }
    blocks_.push_back(b);
  }
}

double FarHeightBound::slope(const Prism& prism, Point2d c, float capture_height_m) {
  if (prism.outline_grid.empty() || prism.height_m <= capture_height_m) return 0.0;
  const Box2d& o = prism.outline_grid;
  const double distance = std::max({o.low.x - c.x, c.x - o.high.x, o.low.y - c.y, c.y - o.high.y, 0.0});
  return std::min(tallest_top, static_cast<double>(prism.height_m - capture_height_m) / distance);
}

float FarHeightBound::top(Cell cell, float capture_height_m) const {
  const Point2d centre = grid_.centre_of(cell);
  const CellRange near = grid_.neighborhood_of(cell);
  double top = 0.0;
  for (const BlockPrism& block : blocks_) {
    if (slope(block.prism, centre, capture_height_m) <= top) continue;
    for (std::size_t n = 0; n < static_cast<std::size_t>(block.cells.size()); ++n) {
      const Cell c = block.cells.cell_at(n);
      if (!near.contains(c)) top = std::max(top, slope(tiles_[cells_.index_of(c)], centre, capture_height_m));
    }
  }
  // One float above, so that the highest point itself lies below the top
  return top > 0.0 ? std::nextafter(static_cast<float>(top), std::numeric_limits<float>::infinity()) : 0.0F;
}

}  // namespace farlod
