// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/grid.hpp"
#include "farlod/pack.hpp"
#include "package/far_map.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// Throws OutputError when a package may not get this name: there is one already and it shall not be replaced, or a folder that
/// holds anything that is not part of a package, or that cannot change its name. Touches nothing.
void require_room(const std::filesystem::path& folder, Overwrite overwrite);

/// The same, whether or not there is a package already.
void require_replaceable(const std::filesystem::path& folder);

/// Gives a finished package its name. What has the name already changes places with it, in one step where the file system can;
/// `aside` is where it is meanwhile where it cannot. Throws OutputError.
void put_in_place(const std::filesystem::path& finished, const std::filesystem::path& package,
                  const std::filesystem::path& aside);

void move_package(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes a package that had the name `package`, if there is one. While a process reads it, it is kept beside that name, as
/// NAME.farlod.replaced-1; this is told. Returns an empty text otherwise.
[[nodiscard]] std::string dispose_of_package(const std::filesystem::path& old, const std::filesystem::path& package);

/// Removes those that were kept, and that nobody reads any more.
void remove_replaced_packages(const std::filesystem::path& package);

/// Writes a block's `far.exr`: a tiled picture whose tile (i, j) is the map of the block's cell (i, j) from its south-west
/// corner; where only the cells `mapped` have maps, their tiles lie in one column (package::picture_tile). Tiles run upwards with
/// j; within a tile of the kind `box`, pictures run downwards, so row 0 is the map's highest; of the kind `horizon`, row 0 is the
/// first patch. Bounds are rounded outwards. Throws std::runtime_error, which says why, when the file cannot be written.
void write_far_maps(const std::filesystem::path& path, const BakedBlock& maps, const CellRange& cells,
                    const package::FarMapShape& shape, const std::optional<package::CellRuns>& mapped = {});

/// Slopes as they come back from the file, where they are half floats: bounds rounded outwards, estimates to the nearest.
void round_as_stored(BakedHorizon& map);

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
