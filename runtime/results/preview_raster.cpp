// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/preview_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

constexpr std::size_t divide_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

float mean_of_square(const SkyRaster& raster, std::size_t column, std::size_t row, std::size_t edge) {
  const std::size_t column_end = std::min(column + edge, raster.columns), row_end = std::min(row + edge, raster.rows);
  double sum = 0.0;
  std::size_t answers = 0;
  for (std::size_t r = row; r < row_end; ++r) {
    for (std::size_t c = column; c < column_end; ++c) {
      const float svf = raster.svf[r * raster.columns + c];
      if (std::isnan(svf)) continue;
      sum += svf;
      ++answers;
    }
  }
  const std::size_t pixels = (column_end - column) * (row_end - row);
  if (2 * answers < pixels) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(sum / static_cast<double>(answers));
}

PreviewRaster shrunk(const SkyRaster& raster, std::size_t factor) {
  PreviewRaster result{
      divide_up(raster.columns, factor), divide_up(raster.rows, factor), raster.step_m * static_cast<double>(factor), {}};
  result.svf.reserve(result.columns * result.rows);
  for (std::size_t row = 0; row < raster.rows; row += factor)
    for (std::size_t column = 0; column < raster.columns; column += factor)
      result.svf.push_back(mean_of_square(raster, column, row, factor));
  return result;
}

PreviewRaster enlarged(const SkyRaster& raster, std::size_t factor) {
  PreviewRaster result{raster.columns * factor, raster.rows * factor, raster.step_m / static_cast<double>(factor), {}};
  result.svf.reserve(result.columns * result.rows);
  for (std::size_t row = 0; row < result.rows; ++row)
    for (std::size_t column = 0; column < result.columns; ++column)
      result.svf.push_back(raster.svf[row / factor * raster.columns + column / factor]);
  return result;
}

}  // namespace

PreviewRaster fit_to_screen(const SkyRaster& raster) {
  FARLOD_EXPECTS(raster.svf.size() == raster.columns * raster.rows);
  const std::size_t longer = std::max({raster.columns, raster.rows, std::size_t{1}});
  if (longer > longest_preview_edge) return shrunk(raster, divide_up(longer, longest_preview_edge));
  return enlarged(raster, std::max(wished_preview_edge / longer, std::size_t{1}));
}

}  // namespace farlod
