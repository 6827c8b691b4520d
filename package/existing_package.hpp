// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "farlod/error.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// Whether a block's `tiles.bin` holds the same tiles as another one that has no far maps. Far maps are not compared: neither the
/// sections of the kind `horizon`, nor the fields of a cell of the kind `box`.
[[nodiscard]] bool same_tiles(std::span<const std::byte> file, std::span<const std::byte> file_without_maps);

/// How much of a new manifest is known.
enum class Known {
  before_tiles,  ///< software, inputs, settings, CRS and grid
  all            ///< heights, counts, problems and crowns, too
};

/// A package on disk, to which far maps are added, or which is made whole again.
class ExistingPackage {
 public:
  /// Reads its manifest, as the runtime does (manifest_from_text). Nothing where the folder has none. Throws OutputError where
  /// the manifest cannot be used.
  [[nodiscard]] static std::optional<ExistingPackage> find(const std::filesystem::path& folder);
  ExistingPackage(ExistingPackage&&) noexcept;
  ExistingPackage& operator=(ExistingPackage&&) noexcept;
  ~ExistingPackage();

  /// Throws OutputError, which names the first difference, where the package is not of the city, the grid and the settings of
  /// `manifest`.
  void require_same(const package::Manifest& manifest, Known known) const;
  /// The same where the tiles of its blocks on disk are not these, bit for bit. Reads all of them. Damaged blocks do not count.
  void require_same_tiles(const TileSet& tiles, const Grid& grid) const;
  /// Whether the files of one of its blocks are those that the manifest names. Reads them, once.
  [[nodiscard]] bool is_whole(const package::BlockFiles& files) const;
  /// The same where somebody has changed the package since it was found.
  void require_unchanged() const;
  /// The blocks of its grid, in the order of Grid::blocks().
  [[nodiscard]] const std::vector<package::BlockFiles>& blocks() const;

 private:
  struct Impl;
  explicit ExistingPackage(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
