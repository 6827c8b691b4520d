// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "base/grid.hpp"
#include "farlod/box.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// Bounds how high the far city can rise above the horizontal, so that a far map spends its rows on what is there.
class FarHeightBound {
 public:
  FarHeightBound(const TileSet& tiles, const Grid& grid);

  /// An upper bound of height over horizontal distance (the longer of |x| and |y|, as in BoxMap::top) over all that lies
  /// outside of the neighborhood of `cell`, seen from its centre at `capture_height_m`; 0 when nothing rises above it.
  [[nodiscard]] float top(Cell cell, float capture_height_m) const;

 private:
  struct Prism {
    Box2d outline_grid;
    float height_m;
  };
  struct BlockPrism {
    Prism prism;
    CellRange cells;
  };
  [[nodiscard]] static double slope(const Prism& prism, Point2d centre_grid, float capture_height_m);

  const Grid& grid_;
  CellRange cells_;
  std::vector<Prism> tiles_;
  std::vector<BlockPrism> blocks_;
};

}  // namespace farlod
