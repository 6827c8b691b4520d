// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace farlod {

/// Heights of a surface at pixels, row by row from the north; NaN where there is none.
struct WallSurface {
  std::size_t columns = 0, rows = 0;
  double step_m = 1.0;
  std::span<const float> height_m;

  [[nodiscard]] float at(std::size_t row, std::size_t column) const { return height_m[row * columns + column]; }
};

/// UMEP's default, below which a step of the surface is no wall.
inline constexpr float least_wall_m = 3.0F;

/// Walls as UMEP's "Wall Height and Aspect" has them: a wall stands on a pixel beside which, in the row or the column, there is a
/// higher one; its height is what the highest of the four is above the pixel. 0 where that is less than least_wall_m, on the
/// first and last rows and columns, and where there is no surface.
[[nodiscard]] std::vector<float> wall_heights(const WallSurface& surface);

/// How far from a pixel its aspect depends on others, in pixels: UMEP looks at 9 m, three pixels at least.
[[nodiscard]] std::size_t aspect_reach(double step_m);

/// The azimuth that each wall faces, in degrees clockwise from the raster's north; 0 where there is no wall. A filter as that of
/// Goodwin et al. 2009: of 180 lines through the pixel, the wall runs along that with the most walls on it, and of the two sides
/// the higher one is behind it. `wall_m` are wall_heights().
///
/// Several lines beside each other have as many walls. The middle one is taken, where UMEP takes the first, up to 7° off.
[[nodiscard]] std::vector<float> wall_aspects(const WallSurface& surface, std::span<const float> wall_m);

}  // namespace farlod
