// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "contract/package/manifest.hpp"
#include "farlod/error.hpp"
#include "farlod/pack.hpp"
#include "farmap/baked_block.hpp"
#include "tiles/tile_set.hpp"

namespace farlod {

/// Throws OutputError when a package may not be written there: the folder holds one already and shall not be replaced, or
/// holds anything that is not part of a package. Touches nothing.
void require_room(const std::filesystem::path& folder, Overwrite overwrite);

/// Writes a package block by block. Every file is written under a temporary name and renamed; the manifest comes last, so that a
/// folder with a manifest is a whole package, whatever happened before.
class PackageWriter {
 public:
  /// Makes the folder. An old package in it loses its manifest at once, and its blocks with it (`replace`), or is left
  /// alone (`refuse`: throws OutputError). A folder that holds anything else is never touched.
  PackageWriter(std::filesystem::path folder, Overwrite overwrite);

  /// Returns the stamps of the block's two files, for the manifest.
  package::BlockFiles write_block(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                  const package::FarMapShape& shape);
  void finish(const package::Manifest& manifest);

  [[nodiscard]] std::uint64_t bytes_written() const { return bytes_written_; }
  /// Of all far maps: their pictures, and their explicit occluders.
  [[nodiscard]] std::uint64_t far_map_bytes() const { return far_map_bytes_; }

 private:
  package::FileStamp write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

  std::filesystem::path folder_;
  std::uint64_t bytes_written_ = 0, far_map_bytes_ = 0;
};

}  // namespace farlod
