// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/pixel_square.hpp"

#include <cmath>

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
  if (is_whole()) {
    set_middle(0, 4);
    return;
  }
  for (std::size_t first = 0; first < 4; ++first) {
    if (!has_height[first] || joined[before(first)]) continue;
    std::size_t count = 1;
    while (count < 4 && joined[(first + count - 1) % 4]) ++count;
    set_middle(first, count);
  }
}

/// Three pixels around a corner lie in a plane, which is half-way between the outer two there.
void PixelSquare::set_middle(std::size_t first, std::size_t count) {
  const auto height = [&](std::size_t n) { return height_m[(first + n) % 4]; };
  const double ends_m = 0.5 * (height(0) + height(count - 1));
  const double at_middle_m = count < 4 ? ends_m : 0.5 * (ends_m + 0.5 * (height(1) + height(2)));
  bool level = true;
  for (std::size_t n = 1; n < count; ++n) level &= height(n) == height(0);
  for (std::size_t n = 0; n < count; ++n) {
    middle_height_m[(first + n) % 4] = level ? height(0) : at_middle_m;
    is_level[(first + n) % 4] = level;
  }
}

std::size_t PixelSquare::fold() const {
  return std::abs(height_m[0] - height_m[2]) <= std::abs(height_m[1] - height_m[3]) ? 0 : 1;
}

}  // namespace farlod::tiles
