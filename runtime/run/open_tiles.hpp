// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "farlod/raster.hpp"

namespace farlod {

/// A rectangle of tiles, half open.
struct TileRange {
  TilePlace begin, end;
};

/// The tiles of a raster that are being filled. The work comes in parts (the cells of a run), whose tiles are known beforehand. A
/// tile is handed on, and forgotten, after the last part that reaches it.
class OpenTiles {
 public:
  /// `parts` are the tiles that each part of the work reaches, in the order in which the parts will be done.
  OpenTiles(const RasterPlan& plan, RasterBands bands, std::size_t further_bands, std::span<const TileRange> parts,
            std::function<void(const RasterTile&)> hand_on);

  /// An answer of the current part, for a pixel of one of its tiles. Bounds are stored when the raster has bands for them.
  struct Answer {
    float svf = 0.0F, low = 0.0F, high = 0.0F;
    std::span<const float> further = {};  ///< of each further band
  };
  void put(std::size_t column, std::size_t row, const Answer& answer);
  /// Ends the current part: hands on the tiles that no later part reaches, row by row from the north-west.
  void part_done();

  [[nodiscard]] std::size_t count() const { return open_.size(); }
  /// The largest number of tiles that will be open at a time.
  [[nodiscard]] static std::size_t most_open(const RasterPlan& plan, std::span<const TileRange> parts);

 private:
  RasterBands bands_;
  std::size_t further_bands_;
  std::function<void(const RasterTile&)> hand_on_;
  std::vector<std::vector<TilePlace>> last_of_part_;
  std::size_t parts_done_ = 0;
  std::map<TilePlace, RasterTile> open_;
};

}  // namespace farlod
