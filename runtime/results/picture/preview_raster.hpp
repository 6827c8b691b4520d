// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "results/raster/raster_frame.hpp"

namespace farlod {

/// A raster at the size of a picture on a screen. NaN where there is no answer.
struct PreviewRaster {
  std::size_t columns = 0, rows = 0;
  double metres_per_pixel = 1.0;
  std::vector<float> svf;  ///< row by row from the north
};

/// Neither edge of a preview is longer than this.
inline constexpr std::size_t longest_preview_edge = 2000;
/// Small rasters are enlarged towards this, by the largest whole factor that does not pass it.
inline constexpr std::size_t wished_preview_edge = 1000;

/// What the largest preview and the picture of it hold in memory: a float and three bytes a pixel. Enlarged ones hold the float
/// twice, and are at most a quarter as large.
inline constexpr std::size_t bytes_of_largest_preview = longest_preview_edge * longest_preview_edge * (sizeof(float) + 3);

/// Fits a raster to a screen: large ones are averaged over squares of whole pixels, small ones repeat each pixel a whole number
/// of times. A square without an answer in most of its pixels has none itself. Tiles come in any order, each once or not at all.
class ScreenFit {
 public:
  explicit ScreenFit(const RasterFrame& frame);
  void add(const RasterTile& tile);
  [[nodiscard]] PreviewRaster preview() const;
  /// What the sums over its squares hold in memory.
  [[nodiscard]] static std::size_t bytes_for(const RasterFrame& frame);

 private:
  [[nodiscard]] float mean_of_square(std::size_t column, std::size_t row) const;

  RasterFrame frame_;
  std::size_t pixels_per_square_;  ///< along an edge
  std::size_t columns_, rows_;     ///< of squares
  std::vector<double> sums_;
  std::vector<std::uint32_t> answers_;
};

}  // namespace farlod
