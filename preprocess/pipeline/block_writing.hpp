// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "farlod/run.hpp"
#include "farmap/far_map_baker.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"
#include "package/unfinished_package.hpp"
#include "pipeline/block_plan.hpp"

namespace farlod::pipeline {

/// What the making of blocks took, and what came of it.
struct BlockTally {
  double bake_s = 0.0, write_s = 0.0;  ///< shares of the wall clock
  std::uint64_t far_map_bytes = 0;     ///< of the far maps that were baked
  std::size_t found = 0;               ///< blocks that were finished already
};

/// From what blocks are made.
struct BlockSource {
  const TileSet& tiles;
  const Grid& grid;
  const package::FarMapShape& shape;
  const FarMapBaker* baker = nullptr;  ///< none where no block needs far maps
};

/// Bakes and writes the blocks of a plan that these places name, as far as they are not finished yet, several at a time: while
/// one is written, another one is baked. Each is recorded when it is on the disk. Throws OutputError, Cancelled.
BlockTally make_blocks(const BlockSource& source, const BlockPlan& plan, std::span<const std::size_t> places,
                       const UnfinishedPackage& unfinished, const RunSettings& run, std::size_t blocks_at_once);

}  // namespace farlod::pipeline
