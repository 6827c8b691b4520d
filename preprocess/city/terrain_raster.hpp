// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// Heights of the ground at the nodes of a regular net in the city frame (not turned: a terrain in another CRS is
/// resampled on reading). Node (column, row) lies at first + (column, row)·step; rows go north.
struct TerrainRaster {
  Point2d first;  ///< the south-west node, city frame
  Point2d step_m{1.0, 1.0};
  std::size_t columns = 0, rows = 0;
  std::vector<std::optional<float>> height_m;  ///< row by row from the south; empty where the raster has no data

  [[nodiscard]] Point2d node(std::size_t column, std::size_t row) const {
    return {first.x + static_cast<double>(column) * step_m.x, first.y + static_cast<double>(row) * step_m.y};
  }
  /// Bilinear height; empty outside or where a node around it has no data.
  [[nodiscard]] std::optional<double> height_at(Point2d p_city) const;
};

}  // namespace farlod
