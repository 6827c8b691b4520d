// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "base/grid.hpp"
#include "package/baked_block.hpp"
#include "package/manifest.hpp"

namespace farlod {

/// Writes a block's `far.exr`: a tiled picture whose tile (i, j) is the map of the block's cell (i, j) from its south-west
/// corner; where only the cells `mapped` have maps, their tiles lie in one column (package::picture_tile). Tiles run upwards with
/// j; within a tile of the kind `box`, pictures run downwards, so row 0 is the map's highest; of the kind `horizon`, row 0 is the
/// first patch. Bounds are rounded outwards. Throws std::runtime_error, which says why, when the file cannot be written.
void write_far_maps(const std::filesystem::path& path, const BakedBlock& maps, const CellRange& cells,
                    const package::FarMapShape& shape, const std::optional<package::CellRuns>& mapped = {});

/// Slopes as they come back from the file, where they are half floats: bounds rounded outwards, estimates to the nearest.
void round_as_stored(BakedHorizon& map);

}  // namespace farlod
