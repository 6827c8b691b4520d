// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

#include "results/raster/raster_frame.hpp"

namespace farlod {

/// A raster with all of its values. The programs never hold one; tests compare with it.
struct WholeRaster : RasterFrame {
  std::vector<float> svf;        ///< row by row from the north, each from the west; NaN where there is no data
  std::vector<float> low, high;  ///< bounds, or empty
};

[[nodiscard]] inline RasterTile tile_of(const WholeRaster& raster, TilePlace place) {
  RasterTile tile(place, raster.bands.size() > 1 ? RasterBands::svf_and_bounds : RasterBands::svf);
  const auto copy = [&](const std::vector<float>& from, std::vector<float>& to) {
    if (to.empty()) return;
    for (std::size_t row = 0; row < pixels_of_tile(place.row, raster.rows); ++row)
      for (std::size_t column = 0; column < pixels_of_tile(place.column, raster.columns); ++column)
        to[row * raster_tile_edge + column] =
            from.at((place.row * raster_tile_edge + row) * raster.columns + place.column * raster_tile_edge + column);
  };
  copy(raster.svf, tile.svf);
  copy(raster.low, tile.low);
  copy(raster.high, tile.high);
  return tile;
}

/// All tiles, row by row from the north-west.
[[nodiscard]] inline std::vector<RasterTile> tiles_of(const WholeRaster& raster) {
  std::vector<RasterTile> tiles;
  for (std::size_t row = 0; row < tiles_along(raster.rows); ++row)
    for (std::size_t column = 0; column < tiles_along(raster.columns); ++column) tiles.push_back(tile_of(raster, {row, column}));
  return tiles;
}

/// Writes the raster by a writer of the programs.
template <class Writer>
void write_whole(const WholeRaster& raster, const std::filesystem::path& path) {
  Writer writer(raster, path);
  for (const RasterTile& tile : tiles_of(raster)) writer.write(tile);
  writer.commit();
}

}  // namespace farlod
