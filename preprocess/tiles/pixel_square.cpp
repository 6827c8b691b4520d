// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/pixel_square.hpp"

namespace farlod::tiles {

PixelSquare::PixelSquare(const TerrainRaster& raster, const PixelSteps& steps, std::size_t column, std::size_t row)
    : middle{2 * static_cast<std::int64_t>(column), 2 * static_cast<std::int64_t>(row)} {
  const auto has_pixel = [&](std::size_t east, std::size_t north) {
    return column + east >= 1 && column + east <= raster.columns && row + north >= 1 && row + north <= raster.rows;
  };
  constexpr std::array<std::array<std::size_t, 2>, 4> places{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [east, north] = places[k];
    if (!has_pixel(east, north)) continue;
    const auto& height = raster.height_m[(row + north - 1) * raster.columns + column + east - 1];
    has_height[k] = height.has_value();
    height_m[k] = height.value_or(0.0F);
  }
  joined = {has_height[0] && has_height[1] && steps.joins_east(column - 1, row - 1),
            has_height[1] && has_height[2] && steps.joins_north(column, row - 1),
            has_height[3] && has_height[2] && steps.joins_east(column - 1, row),
            has_height[0] && has_height[3] && steps.joins_north(column - 1, row - 1)};
  static_cast<PixelMiddle&>(*this) = middle_of(*this);
}

}  // namespace farlod::tiles
