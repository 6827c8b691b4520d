// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/open_tiles.hpp"

#include <algorithm>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// The first and the last part that reach a tile; tiles that none reaches are not in the list.
struct Reached {
  TilePlace place;
  std::size_t first, last;
};

/// Row by row from the north-west.
std::vector<Reached> reached_tiles(const RasterPlan& plan, std::span<const TileRange> parts) {
  std::map<TilePlace, Reached> reached;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    FARLOD_EXPECTS(parts[n].end.column <= tiles_along(plan.columns) && parts[n].end.row <= tiles_along(plan.rows));
    for (std::size_t row = parts[n].begin.row; row < parts[n].end.row; ++row)
      for (std::size_t column = parts[n].begin.column; column < parts[n].end.column; ++column) {
        const TilePlace place{row, column};
        reached.try_emplace(place, Reached{place, n, n}).first->second.last = n;
      }
  }
  std::vector<Reached> tiles;
  for (const auto& [place, tile] : reached) tiles.push_back(tile);
  return tiles;
}

}  // namespace

OpenTiles::OpenTiles(const RasterPlan& plan, RasterBands bands, std::size_t further_bands, std::span<const TileRange> parts,
                     std::function<void(const RasterTile&)> hand_on)
    : bands_(bands), further_bands_(further_bands), hand_on_(std::move(hand_on)), last_of_part_(parts.size()) {
  for (const Reached& tile : reached_tiles(plan, parts)) last_of_part_[tile.last].push_back(tile.place);
}

void OpenTiles::put(std::size_t column, std::size_t row, const Answer& answer) {
  const TilePlace place{row / raster_tile_edge, column / raster_tile_edge};
  RasterTile& tile = open_.try_emplace(place, place, bands_, further_bands_).first->second;
  const std::size_t pixel = row % raster_tile_edge * raster_tile_edge + column % raster_tile_edge;
  tile.svf[pixel] = answer.svf;
  FARLOD_EXPECTS(answer.further.size() == further_bands_);
  for (std::size_t n = 0; n < further_bands_; ++n) tile.further[n][pixel] = answer.further[n];
  if (bands_ == RasterBands::svf) return;
  tile.low[pixel] = answer.low;
  tile.high[pixel] = answer.high;
}

void OpenTiles::part_done() {
  FARLOD_EXPECTS(parts_done_ < last_of_part_.size());
  for (const TilePlace place : last_of_part_[parts_done_++]) {
    const auto tile = open_.find(place);
    if (tile == open_.end()) continue;  // no pixel of it has an answer
    hand_on_(tile->second);
    open_.erase(tile);
  }
}

std::size_t OpenTiles::most_open(const RasterPlan& plan, std::span<const TileRange> parts) {
  std::vector<std::ptrdiff_t> change(parts.size() + 1, 0);
  for (const Reached& tile : reached_tiles(plan, parts)) {
    ++change[tile.first];
    --change[tile.last + 1];
  }
  std::ptrdiff_t open = 0, most = 0;
  for (const std::ptrdiff_t c : change) most = std::max(most, open += c);
  return static_cast<std::size_t>(most);
}

}  // namespace farlod
