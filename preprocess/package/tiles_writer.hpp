// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "farlod/grid.hpp"
#include "farmap/baked_block.hpp"
#include "tiles/tile_set.hpp"

namespace farlod {

/// The bytes of a block's `tiles.bin` (include/farlod/package/layout.hpp), with what its far maps name.
[[nodiscard]] std::vector<std::byte> tiles_file(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block);

}  // namespace farlod
