// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// An ESRI ASCII grid.
struct AsciiGrid {
  std::size_t columns = 0, rows = 0;
  double step_m = 0.0;
  Point2d south_west_m;                       ///< corner of the outermost pixel
  std::vector<std::optional<double>> values;  ///< row by row from the north-west; empty where there is no data

  [[nodiscard]] std::optional<double> at(std::size_t column, std::size_t row) const { return values[row * columns + column]; }
};

/// Throws std::runtime_error naming the file when it is not there, lacks a line of its head or holds another number of values
/// than its head says.
[[nodiscard]] AsciiGrid read_ascii_grid(const std::filesystem::path& file);

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
