// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>

#include "farlod/grid.hpp"
#include "farmap/box_map_baker.hpp"

namespace farlod {

/// Writes a block's `far.exr`: a tiled picture whose tile (i, j) is the map of the block's cell (i, j) from its south-west
/// corner. Tiles run upwards with j; within a tile, pictures run downwards, so row 0 is the map's highest.
/// Throws std::runtime_error when the file cannot be written.
void write_far_maps(const std::filesystem::path& file, std::span<const BakedMap> maps, const CellRange& cells,
                    const FarMapSettings& settings);

}  // namespace farlod
