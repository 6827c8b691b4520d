// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "package/block_tiles.hpp"
#include "package/far_map_reader.hpp"
#include "package/manifest.hpp"
#include "package/mapped_file.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// Something in the files of a block that is not what it should be.
struct BlockDamage {
  std::filesystem::path file;
  std::optional<Cell> cell;  ///< where a single cell is concerned
  std::string what;
};

/// The files of one block, opened to be checked and for nothing else: what is wrong with one of them does not keep the other from
/// being read.
class BlockCheck {
 public:
  /// Compares the files of the n-th block with their checksums, checks the tiles, and opens the far maps. Folder and manifest
  /// must outlive it.
  BlockCheck(const PackageFolder& folder, const package::Manifest& manifest, std::size_t n);

  /// What was wrong so far.
  [[nodiscard]] const std::vector<BlockDamage>& damage() const { return damage_; }
  /// Triangles and cells of the tiles; none where these cannot be read.
  [[nodiscard]] std::optional<std::uint64_t> triangles() const;
  [[nodiscard]] std::int64_t cell_count() const { return cells_.size(); }
  /// The cells whose far maps can be asked for. None when their file cannot be opened.
  [[nodiscard]] const std::vector<Cell>& mapped_cells() const { return mapped_cells_; }
  /// Decodes the far map of one of them. May be asked by many threads.
  [[nodiscard]] std::optional<BlockDamage> check_far_map(Cell cell) const;

 private:
  /// Calls `work`, and keeps what it says of a damage. Returns whether there was none.
  template <class Work>
  bool succeeds(const PackageFile& file, const Work& work);
  void open_tiles();
  void open_far_maps();
  void read_far_map(Cell cell) const;

  const package::Manifest& manifest_;
  const package::BlockFiles& files_;
  CellRange cells_;
  const PackageFolder& folder_;
  std::filesystem::path tiles_name_, far_map_name_;  ///< within the folder
  PackageFile tiles_file_, far_map_file_;
  std::vector<BlockDamage> damage_;
  std::optional<MappedFile> tiles_bytes_;
  std::optional<BlockTiles> tiles_;
  std::optional<FarMapReader> far_maps_;
  std::vector<Cell> mapped_cells_;
};

}  // namespace farlod
