// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "farlod/surfaces.hpp"
#include "results/atomic_file.hpp"
#include "results/raster/raster_writer.hpp"

namespace farlod {

/// A temporary file beside a result, for bytes that are computed before their turn to be written. Removed by the destructor.
class SpoolFile {
 public:
  /// All functions throw OutputError, which names the result.
  explicit SpoolFile(const std::filesystem::path& result);

  /// Returns the position of the bytes.
  [[nodiscard]] std::uint64_t append(std::span<const std::byte> bytes);
  /// Fills `bytes` from this position.
  void read(std::uint64_t place, std::span<std::byte> bytes);

 private:
  std::filesystem::path result_;
  AtomicFile file_;
  std::fstream stream_;
  std::uint64_t end_ = 0;
};

/// Turns tiles that come in any order into whole rows of pixels, for formats that have no tiles. The tiles are kept in a spool
/// file, four bytes a pixel. Bounds are not kept.
class TileSpool {
 public:
  /// `result` is the file that the rows are for. All functions throw OutputError, which names it.
  TileSpool(const RasterFrame& frame, const std::filesystem::path& result);
  void add(const RasterTile& tile);
  /// The pixels of a row of tiles: whole rows of the raster from the north, each from the west. Tiles that did not come hold NaN.
  [[nodiscard]] std::vector<float> pixels_of_tile_row(std::size_t tile_row);
  /// What pixels_of_tile_row() returns holds in memory.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame) {
    return frame.columns * raster_tile_edge * sizeof(float);
  }

 private:
  std::size_t columns_, rows_;
  SpoolFile file_;
  std::map<TilePlace, std::uint64_t> places_;  ///< in the file
};

/// Receivers on surfaces, kept on disk until all have come, for formats whose rows cannot be written as text beforehand. Parts
/// come in any order and go in that of their numbers. All functions throw OutputError, which names the result.
class SurfaceSpool {
 public:
  explicit SurfaceSpool(const std::filesystem::path& result) : file_(result) {}

  /// Each part comes once at the most.
  void add(std::size_t part, std::span<const SurfacePoint> rows);
  /// Hands over all rows, one by one; a row is valid during its call only.
  void for_each(const std::function<void(const SurfacePoint&)>& take);
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  struct Part {
    std::uint64_t begin;
    std::size_t bytes, rows;
  };
  SpoolFile file_;
  std::map<std::size_t, Part> parts_;
  std::size_t size_ = 0;
};

}  // namespace farlod
