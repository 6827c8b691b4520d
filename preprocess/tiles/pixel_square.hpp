// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/frame.hpp"
#include "city/city_model.hpp"
#include "package/pixel_middle.hpp"
#include "tiles/pixel_steps.hpp"

namespace farlod::tiles {

/// A place of a raster, in halves of a pixel from its south-west corner: centres of pixels are odd, their corners even.
struct HalfPixels {
  std::int64_t x = 0, y = 0;
};

/// Places of a raster in the grid frame.
class PixelPlaces {
 public:
  PixelPlaces(const TerrainRaster& raster, const GridRotation& rotation) : raster_(raster), rotation_(rotation) {}
  [[nodiscard]] Point3d operator()(HalfPixels p, double height_m) const {
    const Point2d p_city{raster_.first.x + 0.5 * static_cast<double>(p.x - 1) * raster_.step_m.x,
                         raster_.first.y + 0.5 * static_cast<double>(p.y - 1) * raster_.step_m.y};
    const Point2d p_grid = rotation_.grid_from_city(p_city);
    return {p_grid.x, p_grid.y, height_m};
  }

 private:
  const TerrainRaster& raster_;
  const GridRotation& rotation_;
};

/// The square between the centres of four pixels. Pixels beyond the raster have no height.
struct PixelSquare : FourPixels, PixelMiddle {
  PixelSquare(const TerrainRaster& raster, const PixelSteps& steps, std::size_t column, std::size_t row);

  [[nodiscard]] HalfPixels centre_of(std::size_t k) const { return {middle.x + aside[k].x, middle.y + aside[k].y}; }
  /// The middle of side k, on the side that both pixels share.
  [[nodiscard]] HalfPixels middle_of_side(std::size_t k) const {
    return {middle.x + (aside[k].x + aside[next(k)].x) / 2, middle.y + (aside[k].y + aside[next(k)].y) / 2};
  }

  static constexpr std::array<HalfPixels, 4> aside{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  HalfPixels middle;  ///< the corner that the four share
};

}  // namespace farlod::tiles
