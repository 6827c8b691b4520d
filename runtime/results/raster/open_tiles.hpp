// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "results/raster/raster_tile.hpp"

namespace farlod {

/// A rectangle of tiles, half open.
struct TileRange {
  TilePlace begin, end;
};

/// The tiles of a raster that some parts of the work have reached and others still will. A part is whatever is done in one go and
/// knows which tiles it may reach; a tile is handed on, and forgotten, with the last part that reaches it.
class OpenTiles {
 public:
  /// `parts` are the tiles that each part of the work reaches, in the order in which the parts will be done.
  OpenTiles(const RasterFrame& frame, std::span<const TileRange> parts, std::function<void(const RasterTile&)> hand_on);

  /// An answer of the part that is being done, for a pixel of one of its tiles. Bounds count where the raster has bands for them.
  struct Answer {
    float svf = 0.0F, low = 0.0F, high = 0.0F;
  };
  void put(std::size_t column, std::size_t row, const Answer& answer);
  /// The next part is done: hands on, from the north-west, the tiles that were its last.
  void part_done();

  [[nodiscard]] std::size_t count() const { return open_.size(); }
  /// The most tiles that will be open at a time.
  [[nodiscard]] static std::size_t most_open(const RasterFrame& frame, std::span<const TileRange> parts);

 private:
  RasterBands bands_;
  std::function<void(const RasterTile&)> hand_on_;
  std::vector<std::vector<TilePlace>> last_of_part_;
  std::size_t parts_done_ = 0;
  std::map<TilePlace, RasterTile> open_;
};

}  // namespace farlod
