// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

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
  /// Adds far maps to the package in the folder. Its files stay as they are until finish(); a writer that goes before removes
  /// what it wrote.
  [[nodiscard]] static PackageWriter adding_to(std::filesystem::path folder) { return PackageWriter(std::move(folder)); }
  ~PackageWriter();
  PackageWriter(const PackageWriter&) = delete;
  PackageWriter& operator=(const PackageWriter&) = delete;

  /// Returns the stamps of the block's two files, for the manifest. `maps` are those of the cells `mapped`, of all cells where
  /// that is absent. For several blocks, it may be called from several threads.
  package::BlockFiles write_block(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                  const package::FarMapShape& shape, const std::optional<package::CellRuns>& mapped = {});
  /// Of a package to which was added, the folders of blocks that the manifest does not name any more are removed.
  void finish(const package::Manifest& manifest);

  [[nodiscard]] std::uint64_t bytes_written() const { return bytes_written_; }
  /// Of all far maps: their pictures, and their explicit occluders.
  [[nodiscard]] std::uint64_t far_map_bytes() const { return far_map_bytes_; }

 private:
  explicit PackageWriter(std::filesystem::path folder) : folder_(std::move(folder)), adds_(true) {}
  package::FileStamp write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

  void remove_all_but(const package::Manifest& manifest) const;

  std::filesystem::path folder_;
  bool adds_ = false;
  std::mutex mutex_;
  std::vector<std::filesystem::path> added_;  ///< folders of blocks that the manifest does not name yet
  std::atomic<std::uint64_t> bytes_written_ = 0, far_map_bytes_ = 0;
};

}  // namespace farlod
