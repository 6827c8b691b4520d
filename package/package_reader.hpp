// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "package/block_tiles.hpp"
#include "package/crowns_file.hpp"
#include "package/far_map.hpp"
#include "package/far_map_reader.hpp"
#include "package/far_terrain.hpp"
#include "package/least_recently_used.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {

/// A package that is not on disk: farlod-pack tries far maps out before it writes any.
struct PackageInMemory {
  package::Manifest manifest;                     ///< sizes and checksums of files do not count
  std::vector<std::span<const std::byte>> tiles;  ///< the bytes of `tiles.bin` of each block, in the order of Grid::blocks()
  std::map<Cell, FarHorizon> far_horizons;        ///< of the cells that will be asked for
  MeshView far_terrain = {};                      ///< as PackageReader::far_terrain
};

/// A package, usually on disk. Blocks are mapped and checked against their checksums when they are first asked for, and kept in
/// memory as far as there is room. One that was not asked for the longest gives its memory to the next: what was handed out of it
/// stays where it is and readable, since the mapping stays, and comes from the disk again when somebody reads it. What is made
/// and not read, of a rough surface, lasts as long as somebody has a view of it. All questions may be asked from many threads.
class PackageReader {
 public:
  /// Reads the manifest only. Throws PackageUnusable or PackageDamaged, as do all the other functions when they meet a
  /// block that is not what the manifest says.
  explicit PackageReader(const std::filesystem::path& folder);
  /// The bytes of the tiles, and what the far maps view, and the far terrain must outlive it. It has no far maps of the kind
  /// `box`.
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
  /// The block that owns a cell of the grid, as its file has it; the cell must exist.
  [[nodiscard]] const BlockTiles& block_tiles(Cell cell) const;
  /// The tile of a cell of the grid, with the squares of pixels that its file lacks (ReliefTiles); the cell must exist.
  [[nodiscard]] TileView tile(Cell cell) const;
  /// The least z_low_m and the greatest z_high_m of all cells; low > high where there is no vertex. Reads the records of the
  /// cells alone, without the checksums of their files.
  [[nodiscard]] std::pair<float, float> z_range_m() const;
  /// The cell must exist.
  [[nodiscard]] bool has_far_map(Cell cell) const;
  /// For packages whose far maps are of the kind `box`, and a cell that has one.
  [[nodiscard]] BoxFarMap box_far_map(Cell cell) const;
  /// For packages whose far maps are of the kind `horizon`, and a cell that has one. The package must outlive it.
  [[nodiscard]] FarHorizon far_horizon(Cell cell) const;
  /// Bytes that the picture of a cell's far map takes on disk; the cell must have one. Not of a package in memory.
  [[nodiscard]] std::uint64_t far_map_bytes(Cell cell) const;

  /// Whether there are trees. Never in a package in memory.
  [[nodiscard]] bool has_crowns() const;
  /// For a package that has crowns. The file is opened when it is first asked for.
  [[nodiscard]] const CrownsFile& crowns() const;
  /// The crowns whose axes lie in a cell, in the frame of the cell, which must exist; none where there are no trees.
  [[nodiscard]] std::span<const Crown> crowns_of(Cell cell) const;

  /// The ground beyond the grid, in the frame of FarTerrain; empty where none is known. The file is opened when it is first asked
  /// for.
  [[nodiscard]] MeshView far_terrain() const;

  /// The surface of the raster that the city is, where the package knows it by pixels; null elsewhere. The file is opened when it
  /// is first asked for.
  [[nodiscard]] const PixelHeightsFile* pixel_heights() const;

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
