// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "package/block_tiles.hpp"
#include "package/crowns_file.hpp"
#include "package/far_horizon.hpp"
#include "package/far_map_reader.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// A package that is not on disk: farlod-pack tries far maps out before it writes any.
struct PackageInMemory {
  package::Manifest manifest;                     ///< sizes and checksums of files do not count
  std::vector<std::span<const std::byte>> tiles;  ///< the bytes of `tiles.bin` of each block, in the order of Grid::blocks()
  std::map<Cell, FarHorizon> far_horizons;        ///< of the cells that will be asked for
};

/// A package, usually on disk. Blocks are mapped and checked against their checksums when they are first asked for, and kept in
/// memory as far as there is room. One that was not asked for the longest gives its memory to the next: what was handed out of it
/// stays where it is and readable, since the mapping stays, and comes from the disk again when somebody reads it. All questions
/// may be asked from many threads.
class PackageReader {
 public:
  /// Reads the manifest only. Throws PackageUnusable or PackageDamaged, as do all the other functions when they meet a
  /// block that is not what the manifest says.
  explicit PackageReader(const std::filesystem::path& folder);
  /// The bytes of the tiles, and what the far maps view, must outlive it. It has no far maps of the kind `box`.
  explicit PackageReader(PackageInMemory contents);
  PackageReader(PackageReader&&) noexcept;
  PackageReader& operator=(PackageReader&&) noexcept;
  ~PackageReader();

  [[nodiscard]] const package::Manifest& manifest() const;
  /// Not of a package in memory.
  [[nodiscard]] const PackageFolder& folder() const;
  [[nodiscard]] const Grid& grid() const { return manifest().grid; }

  /// What the manifest says of the block that owns a cell of the grid; the cell must exist.
  [[nodiscard]] const package::BlockFiles& files_of(Cell cell) const;
  /// The block that owns a cell of the grid; the cell must exist.
  [[nodiscard]] const BlockTiles& block_tiles(Cell cell) const;
  [[nodiscard]] TileView tile(Cell cell) const { return block_tiles(cell).tile(cell); }
  /// The least z_low_m and the greatest z_high_m of all cells; low > high where there is no vertex. Reads the records of the
  /// cells alone, without the checksums of their files.
  [[nodiscard]] std::pair<float, float> z_range_m() const;
  /// The cell must exist.
  [[nodiscard]] bool has_far_map(Cell cell) const;
  /// Of packages whose far maps are of the kind `box`, for a cell that has one.
  [[nodiscard]] BoxFarMap box_far_map(Cell cell) const;
  /// Of packages whose far maps are of the kind `horizon`, for a cell that has one. The package must outlive it.
  [[nodiscard]] FarHorizon far_horizon(Cell cell) const;
  /// Bytes that the picture of a cell's far map takes on disk; the cell must have one. Not of a package in memory.
  [[nodiscard]] std::uint64_t far_map_bytes(Cell cell) const;

  /// Whether there are trees. Never in a package in memory.
  [[nodiscard]] bool has_crowns() const;
  /// Of a package that has crowns. It is opened when it is first asked for.
  [[nodiscard]] const CrownsFile& crowns() const;
  /// The crowns whose axes lie in a cell, in the frame of the cell, which must exist; none where there are no trees.
  [[nodiscard]] std::span<const Crown> crowns_of(Cell cell) const;

  /// Compares the manifest and all files that were opened with what they were then: mapped memory is what a file is now, so that
  /// what was checked once may have changed. Throws PackageDamaged. Nothing of a package in memory.
  void require_unchanged() const;

  /// From the next question on, the blocks hold no more memory than this together, except that one block always has room. There
  /// is no such limit before.
  void hold_at_most(std::uint64_t bytes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
