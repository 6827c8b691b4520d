// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "city/terrain_raster.hpp"

#include <algorithm>
#include <cmath>

namespace farlod {

std::optional<double> TerrainRaster::height_at(Point2d p_city) const {
  if (columns < 2 || rows < 2) return std::nullopt;
  const double u = (p_city.x - first.x) / step_m.x;
  const double v = (p_city.y - first.y) / step_m.y;
  if (!(u >= 0.0 && v >= 0.0 && u <= static_cast<double>(columns - 1) && v <= static_cast<double>(rows - 1))) return std::nullopt;
  const std::size_t column = std::min(static_cast<std::size_t>(u), columns - 2);
  const std::size_t row = std::min(static_cast<std::size_t>(v), rows - 2);
  const auto* south = &height_m[row * columns + column];
  const auto* north = south + columns;
  if (!south[0] || !south[1] || !north[0] || !north[1]) return std::nullopt;
  const double s = u - static_cast<double>(column), t = v - static_cast<double>(row);
  return (1.0 - t) * ((1.0 - s) * *south[0] + s * *south[1]) + t * ((1.0 - s) * *north[0] + s * *north[1]);
}

}  // namespace farlod
