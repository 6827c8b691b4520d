// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "results/sky_raster.hpp"

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

/// Fits a raster to a screen: large ones are averaged over squares of whole pixels, small ones repeat each pixel a whole number
/// of times. A square without an answer in most of its pixels has none itself.
[[nodiscard]] PreviewRaster fit_to_screen(const SkyRaster& raster);

}  // namespace farlod
