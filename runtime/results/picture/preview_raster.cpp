// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/preview_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farlod {
namespace {

constexpr std::size_t divide_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

std::size_t longer_edge(const RasterFrame& frame) { return std::max({frame.columns, frame.rows, std::size_t{1}}); }

PreviewRaster enlarged(const PreviewRaster& raster, std::size_t factor) {
  PreviewRaster result{raster.columns * factor, raster.rows * factor, raster.metres_per_pixel / static_cast<double>(factor), {}};
  result.svf.reserve(result.columns * result.rows);
  for (std::size_t row = 0; row < result.rows; ++row)
    for (std::size_t column = 0; column < result.columns; ++column)
      result.svf.push_back(raster.svf[row / factor * raster.columns + column / factor]);
  return result;
}

}  // namespace

ScreenFit::ScreenFit(const RasterFrame& frame)
    : frame_(frame),
      pixels_per_square_(divide_up(longer_edge(frame), longest_preview_edge)),
      columns_(divide_up(frame.columns, pixels_per_square_)),
      rows_(divide_up(frame.rows, pixels_per_square_)),
      sums_(columns_ * rows_),
      answers_(columns_ * rows_) {}

void ScreenFit::add(const RasterTile& tile) {
  const std::size_t columns = pixels_of_tile(tile.place.column, frame_.columns);
  for (std::size_t row = 0; row < pixels_of_tile(tile.place.row, frame_.rows); ++row) {
    const std::size_t first = (tile.place.row * raster_tile_edge + row) / pixels_per_square_ * columns_;
    for (std::size_t column = 0; column < columns; ++column) {
      const float svf = tile.svf[row * raster_tile_edge + column];
      if (std::isnan(svf)) continue;
      const std::size_t square = first + (tile.place.column * raster_tile_edge + column) / pixels_per_square_;
      sums_[square] += svf;
      ++answers_[square];
    }
  }
}

float ScreenFit::mean_of_square(std::size_t column, std::size_t row) const {
  const std::size_t width = std::min(pixels_per_square_, frame_.columns - column * pixels_per_square_);
  const std::size_t height = std::min(pixels_per_square_, frame_.rows - row * pixels_per_square_);
  const std::size_t square = row * columns_ + column;
  if (answers_[square] == 0 || 2 * std::size_t{answers_[square]} < width * height) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(sums_[square] / answers_[square]);
}

PreviewRaster ScreenFit::preview() const {
  PreviewRaster result{columns_, rows_, frame_.step_m * static_cast<double>(pixels_per_square_), {}};
  result.svf.reserve(sums_.size());
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column) result.svf.push_back(mean_of_square(column, row));
  return enlarged(result, std::max(wished_preview_edge / std::max({columns_, rows_, std::size_t{1}}), std::size_t{1}));
}

std::size_t ScreenFit::bytes_for(const RasterFrame& frame) {
  const std::size_t square = divide_up(longer_edge(frame), longest_preview_edge);
  return divide_up(frame.columns, square) * divide_up(frame.rows, square) * (sizeof(double) + sizeof(std::uint32_t));
}

}  // namespace farlod
