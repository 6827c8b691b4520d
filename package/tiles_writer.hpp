// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/grid.hpp"
#include "package/baked_block.hpp"
#include "package/cell_runs.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// The bytes of a block's `tiles.bin` (package/layout.hpp), with the explicit occluders of its far maps. `maps` are
/// those of the cells `mapped`, in their order; of all cells where `mapped` is absent.
[[nodiscard]] std::vector<std::byte> tiles_file(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                                const std::optional<package::CellRuns>& mapped = {});

/// The same without far maps: of a block that has none, or to be read together with maps that are not in a file.
[[nodiscard]] std::vector<std::byte> tiles_file_without_maps(const TileSet& tiles, const Grid& grid, Block block);

}  // namespace farlod
