// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "results/raster/raster_frame.hpp"
#include "results/spool_file.hpp"

namespace farlod {

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

}  // namespace farlod
