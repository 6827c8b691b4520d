// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "farlod/run.hpp"
#include "farmap/far_map_baker.hpp"
#include "package/package_writer.hpp"
#include "pipeline/pack.hpp"

namespace farlod::pipeline {

/// Bakes and writes all blocks of a city, and adds them to the manifest, with the seconds of both. With two blocks at once, one
/// is written while the next one is baked. Throws OutputError, Cancelled.
void write_all_blocks(const TileSet& tiles, const FarMapBaker& baker, PackageWriter& writer, std::size_t blocks_at_once,
                      const RunSettings& run, PackedCity& result);

}  // namespace farlod::pipeline
