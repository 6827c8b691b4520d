// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/tile_spool.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace farlod {

TileSpool::TileSpool(const RasterFrame& frame, const std::filesystem::path& result)
    : columns_(frame.columns), rows_(frame.rows), file_(result) {}

void TileSpool::add(const RasterTile& tile) { places_.emplace(tile.place, file_.append(std::as_bytes(bands_of(tile).front()))); }

std::vector<float> TileSpool::pixels_of_tile_row(std::size_t tile_row) {
  const std::size_t rows = pixels_of_tile(tile_row, rows_);
  std::vector<float> pixels(columns_ * rows, std::numeric_limits<float>::quiet_NaN());
  std::vector<float> tile(raster_tile_edge * raster_tile_edge);
  for (auto t = places_.lower_bound({tile_row, 0}); t != places_.end() && t->first.row == tile_row; ++t) {
    file_.read(t->second, std::as_writable_bytes(std::span(tile)));
    const std::size_t tile_column = t->first.column, columns = pixels_of_tile(tile_column, columns_);
    for (std::size_t row = 0; row < rows; ++row)
      std::copy_n(tile.data() + row * raster_tile_edge, columns, pixels.data() + row * columns_ + tile_column * raster_tile_edge);
  }
  return pixels;
}

}  // namespace farlod
