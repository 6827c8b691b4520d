// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/frame.hpp"
#include "city/city_model.hpp"
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

/// The square between the centres of four pixels, around the corner that they share. They are numbered counter-clockwise from the
/// south-west, and side k of the square runs from pixel k to the next one. Pixels beyond the raster have no height.
struct PixelSquare {
  PixelSquare(const TerrainRaster& raster, const PixelSteps& steps, std::size_t column, std::size_t row);

  [[nodiscard]] static std::size_t next(std::size_t k) { return (k + 1) % 4; }
  [[nodiscard]] static std::size_t before(std::size_t k) { return (k + 3) % 4; }
  [[nodiscard]] HalfPixels centre_of(std::size_t k) const { return {middle.x + aside[k].x, middle.y + aside[k].y}; }
  /// The middle of side k, on the side that both pixels share.
  [[nodiscard]] HalfPixels middle_of(std::size_t k) const {
    return {middle.x + (aside[k].x + aside[next(k)].x) / 2, middle.y + (aside[k].y + aside[next(k)].y) / 2};
  }
  /// All four are joined: the surface is one piece without a fold at its middle.
  [[nodiscard]] bool is_whole() const { return joined[0] && joined[1] && joined[2] && joined[3]; }
  /// The corners at the ends of the diagonal that folds a whole square: where heights differ less.
  [[nodiscard]] std::size_t fold() const;

  static constexpr std::array<HalfPixels, 4> aside{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  HalfPixels middle;                        ///< the corner that the four share
  std::array<bool, 4> has_height{};         ///< of the pixels
  std::array<double, 4> height_m{};         ///< at their centres
  std::array<bool, 4> joined{};             ///< by side: its pixels are joined
  std::array<double, 4> middle_height_m{};  ///< of the surface of each pixel, at the middle of the square
  std::array<bool, 4> is_level{};  ///< the pixel and those that are joined with it here, one after the other, are as high

 private:
  void set_middle(std::size_t first, std::size_t count);
};

}  // namespace farlod::tiles
