// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>

#include "validation/ascii_grid.hpp"

namespace farlod {

/// Which pixels of the reference are compared.
struct ComparedPixels {
  std::size_t rim = 0;                ///< left out: this many pixels along each border of the reference
  const AsciiGrid* height = nullptr;  ///< with it, only pixels whose height lies in [low_m, high_m)
  double low_m = -std::numeric_limits<double>::infinity();
  double high_m = std::numeric_limits<double>::infinity();
};

/// How far a raster is from a reference. All are 0 when nothing was compared.
struct RasterDifference {
  std::size_t count = 0;     ///< pixels that have a value in both
  double bias = 0.0;         ///< mean of raster minus reference
  double correlation = 0.0;  ///< Pearson's; 0 when one of the two is constant
  double rms = 0.0;
  double p99_abs = 0.0;  ///< 99 of 100 differences are no larger
  double max_abs = 0.0;
};

/// Compares pixel by pixel where the two overlap. Throws std::runtime_error when their pixels, or those of the heights, do not
/// lie one on the other: an answer for another place is not an error of the answer.
[[nodiscard]] RasterDifference compare_rasters(const AsciiGrid& raster, const AsciiGrid& reference,
                                               const ComparedPixels& pixels = {});

}  // namespace farlod
