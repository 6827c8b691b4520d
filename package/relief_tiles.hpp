// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "base/grid.hpp"
#include "package/block_tiles.hpp"
#include "package/least_recently_used.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {

/// A tile of a rough surface as a whole: what its file holds, and behind it the squares between pixels that are in no file
/// (PixelSquares). docs/package_format.md, "Squares of pixels", tells the same in words.
struct ReliefTile {
  package::CellRecord cell{};
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  std::vector<package::SurfaceRun> runs;
  std::vector<package::TileEdge> grounded_sides;

  [[nodiscard]] std::size_t bytes() const;
};

/// Adds the squares of a cell to what its file holds.
///   (1) triangles and edges are those of the surface that was packed: two of a square, which folds as its pixel says; and as
///       edges the folds, and the sides between two such squares, that can be a horizon (UpperFacets)
///   (2) vertices have the bits of those that the file holds at the same places, and each is there once
/// Throws PackageDamaged where the file has squares and no ground.
[[nodiscard]] ReliefTile relief_tile(const TileView& stored, Cell cell, const PixelHeightsFile& heights,
                                     const package::SurfacePixels& pixels, const Grid& grid);

/// The tiles of a package of a rough surface, each made when it is asked for. Those asked for last are kept. Threads may share
/// it.
class ReliefTiles {
 public:
  /// All must outlive it.
  ReliefTiles(const PixelHeightsFile& heights, const package::SurfacePixels& pixels, const Grid& grid);

  /// The whole tile of a cell. It lasts as long as the view, or a copy of its mesh.
  [[nodiscard]] TileView whole(const TileView& stored, Cell cell);

  /// What is kept takes no more. A thread needs nine tiles at a time, of a megabyte each where pixels have a metre.
  static constexpr std::uint64_t most_bytes = std::uint64_t{48} << 20U;

 private:
  /// What has been read of the heights is given back after so many tiles.
  static constexpr std::size_t tiles_between_pauses = 64;

  [[nodiscard]] std::shared_ptr<const ReliefTile> find(std::size_t number);
  void keep(std::size_t number, const std::shared_ptr<const ReliefTile>& tile);

  const PixelHeightsFile& heights_;
  const package::SurfacePixels& pixels_;
  const Grid& grid_;
  std::mutex mutex_;
  LruCache used_;
  std::unordered_map<std::size_t, std::shared_ptr<const ReliefTile>> kept_;
  std::size_t made_ = 0;
};

}  // namespace farlod
