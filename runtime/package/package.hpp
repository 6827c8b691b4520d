// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "farlod/package/manifest.hpp"
#include "package/block_tiles.hpp"
#include "package/far_map_reader.hpp"

namespace farlod {

/// A package on disk. Blocks are mapped, checked against their checksums and kept when they are first asked for.
/// All questions may be asked from many threads.
class Package {
 public:
  /// Reads the manifest only. Throws PackageUnusable or PackageDamaged, as do all the other functions when they meet a
  /// block that is not what the manifest says.
  explicit Package(std::filesystem::path folder);
  Package(Package&&) noexcept;
  Package& operator=(Package&&) noexcept;
  ~Package();

  [[nodiscard]] const package::Manifest& manifest() const;
  [[nodiscard]] const Grid& grid() const { return manifest().grid; }

  /// The block that owns a cell of the grid; the cell must exist.
  [[nodiscard]] const BlockTiles& block_tiles(Cell cell) const;
  [[nodiscard]] TileView tile(Cell cell) const { return block_tiles(cell).tile(cell); }
  /// Of packages whose far maps are of the kind `box`.
  [[nodiscard]] BoxFarMap box_far_map(Cell cell) const;
  /// Of packages whose far maps are of the kind `horizon`. The package must outlive it.
  [[nodiscard]] FarHorizon far_horizon(Cell cell) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
