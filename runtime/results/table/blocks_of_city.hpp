// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "farlod/inspection.hpp"

namespace farlod {

/// Calls `work` with the cells of a package block by block, so that the geometry of one is in memory at a time. Blocks that are
/// larger than geometry_of() takes come in parts.
template <class Work>
void for_each_block(const PackageInventory& package, const Work& work) {
  constexpr std::int32_t longest_edge = 100;
  const CellRectangle& all = package.cells;
  const std::int32_t edge = std::min(package.block_edge, longest_edge);
  for (std::int32_t j = all.j_begin; j < all.j_end; j += edge)
    for (std::int32_t i = all.i_begin; i < all.i_end; i += edge)
      work(CellRectangle{i, j, std::min(i + edge, all.i_end), std::min(j + edge, all.j_end)});
}

}  // namespace farlod
