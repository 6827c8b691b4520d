// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/modelled_ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace farlod::tiles {

ModelledGround::ModelledGround(const TerrainRaster& raster, const PixelSteps& steps, const GridRotation& rotation)
    : raster_(raster), rotation_(rotation), surface_(stepped_surface(raster, steps, rotation)) {
  for (const auto& height_m : raster.height_m)
    if (height_m) lowest_m_ = std::min<double>(lowest_m_.value_or(*height_m), *height_m);
}

double ModelledGround::height_at(Point2d p_grid) const {
  const Point2d p = rotation_.city_from_grid(p_grid) - raster_.first;
  const auto pixel = [](double steps, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::round(steps), 0.0, static_cast<double>(count - 1)));
  };
  const std::size_t column = pixel(p.x / raster_.step_m.x, raster_.columns), row = pixel(p.y / raster_.step_m.y, raster_.rows);
  const auto* const heights = &raster_.height_m[row * raster_.columns];
  for (std::size_t apart = 0; apart < raster_.columns; ++apart) {
    if (apart <= column && heights[column - apart]) return *heights[column - apart];
    if (column + apart < raster_.columns && heights[column + apart]) return *heights[column + apart];
  }
  return lowest_m_.value_or(0.0);
}

}  // namespace farlod::tiles
