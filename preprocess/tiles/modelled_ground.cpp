// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/modelled_ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/expects.hpp"

namespace farlod::tiles {

ModelledGround::ModelledGround(const TerrainRaster& raster, PixelSteps steps, const GridRotation& rotation)
    : raster_(raster), steps_(std::move(steps)), rotation_(rotation) {
  for (const auto& height_m : raster.height_m)
    if (height_m) lowest_m_ = std::min<double>(lowest_m_.value_or(*height_m), *height_m);
}

std::uint64_t ModelledGround::leave_out_squares(const Grid& grid, SquaresOfReaders squares,
                                                const std::function<bool(std::uint64_t)>& are_enough) {
  FARLOD_EXPECTS(!surface_);
  squares_ = squares;
  return steps_.leave_out_squares(raster_, grid, are_enough);
}

const SteppedSurface& ModelledGround::surface() const {
  if (!surface_) surface_ = stepped_surface(raster_, steps_, rotation_, squares_);
  return *surface_;
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
