// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "package/baked_block.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// Writes the files of a package, block by block, into a folder. Every file is on the disk before it has its name.
class PackageWriter {
 public:
  explicit PackageWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Returns the stamps of the block's two files, for the manifest. `maps` are those of the cells `mapped`, of all cells where
  /// that is absent. For several blocks, it may be called from several threads. Throws OutputError.
  package::BlockFiles write_block(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                  const package::FarMapShape& shape, const std::optional<package::CellRuns>& mapped = {});
  /// Makes a package of the blocks. Throws OutputError.
  void write_manifest(const package::Manifest& manifest);

  /// Bytes of all far maps: their pictures, and their explicit occluders.
  [[nodiscard]] std::uint64_t far_map_bytes() const { return far_map_bytes_; }

 private:
  std::filesystem::path folder_;
  std::atomic<std::uint64_t> far_map_bytes_ = 0;
};

}  // namespace farlod
