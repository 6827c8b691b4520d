// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "base/paging/paged_array.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// Heights of crowns in square cells, in the city frame. Rows and columns may run any way, at right angles.
struct CanopyRaster {
  std::string source;                                  ///< the file's name as the user gave it
  Point2d first;                                       ///< the centre of cell (0, 0)
  Point2d column_step{1.0, 0.0}, row_step{0.0, -1.0};  ///< to the next column and to the next row; equally long
  std::size_t columns = 0, rows = 0;
  PagedArray<float> top_m;    ///< row by row; NaN: no data
  PagedArray<float> trunk_m;  ///< the same: where crowns begin; NaN: not known. Empty where there is no such raster

  [[nodiscard]] Point2d centre(std::size_t column, std::size_t row) const {
    return first + static_cast<double>(column) * column_step + static_cast<double>(row) * row_step;
  }
};

}  // namespace farlod
