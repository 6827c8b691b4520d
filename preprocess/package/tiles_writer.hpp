// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "farlod/grid.hpp"
#include "farmap/box_map_baker.hpp"
#include "tiles/tile_set.hpp"

namespace farlod {

/// The bytes of a block's `tiles.bin` (include/farlod/package/layout.hpp). `maps` are those of the block's cells, in order.
[[nodiscard]] std::vector<std::byte> tiles_file(const TileSet& tiles, std::span<const BakedMap> maps, const Grid& grid,
                                                Block block);

}  // namespace farlod
