// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "farlod/raster.hpp"

namespace farlod {

/// Place, size and bands of a north-up raster in the output CRS, without its values. Row 0 is the northernmost.
struct RasterFrame {
  Point2d north_west_m;  ///< the outer corner of the first pixel, projected frame
  double step_m = 1.0;   ///< edge of a pixel
  std::size_t columns = 0, rows = 0;
  RasterBands bands = RasterBands::svf;
  std::string quantity;  ///< "svf" or "svf_solid": the name of the first band; `_low` and `_high` are those of the bounds
  std::string crs_wkt;
  std::optional<int> epsg = {};      ///< the same CRS by its code, where it has one
  std::size_t threads = 1;           ///< of the run; a writer that compresses may use some. They change no byte
  const Package* package = nullptr;  ///< whose outlines and ground a picture shows; none of them where there is none
};

}  // namespace farlod
