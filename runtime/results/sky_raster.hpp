// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// What a raster has for each pixel: an answer, or certain bounds beside it.
enum class RasterBands { answers, answers_and_bounds };

/// A north-up raster in the output CRS, without its values. Row 0 is the northernmost.
struct RasterFrame {
  Point2d north_west_m;  ///< the outer corner of the first pixel, projected frame
  double step_m = 1.0;   ///< edge of a pixel
  std::size_t columns = 0, rows = 0;
  RasterBands bands = RasterBands::answers;
  std::string quantity;  ///< "svf" or "svf_solid": the name of the first band; `_low` and `_high` are those of the bounds
  std::string crs_wkt;
  std::optional<int> epsg = {};  ///< the same CRS by its code, where it has one

  [[nodiscard]] Point2d centre_m(std::size_t column, std::size_t row) const {
    return {north_west_m.x + (static_cast<double>(column) + 0.5) * step_m,
            north_west_m.y - (static_cast<double>(row) + 0.5) * step_m};
  }
};

/// A raster as a whole. A pixel without an answer (its centre lies inside a building) holds NaN.
struct SkyRaster : RasterFrame {
  std::vector<float> svf;        ///< row by row from the north, each from the west
  std::vector<float> low, high;  ///< certain bounds; empty unless `bands` says that they are there
};

}  // namespace farlod
