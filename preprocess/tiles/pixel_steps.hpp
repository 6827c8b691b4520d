// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "package/pixel_heights.hpp"

namespace farlod::tiles {

/// Two pixels beside each other are a step apart when their heights differ by more than all of
///   (1) `least_m`: of what is lower (a bank, a parapet, noise) nobody can tell whether it is upright
///   (2) `least_slope` times what they are apart
///   (3) `contrast` times the difference that continues the same way on either side: a slope is no step
inline constexpr struct { double least_m = 2.0, least_slope = 0.5, contrast = 3.0; } step_rule;

/// Pixels that are wider than this show slopes where there are walls; whether their steps are walls, nobody can tell.
inline constexpr double widest_pixel_with_walls_m = 5.0;

/// Which pixels of a raster of heights are joined with the one beside them: both have a height, and no step is between them.
class PixelSteps {
 public:
  explicit PixelSteps(const TerrainRaster& raster);

  [[nodiscard]] bool joins_east(std::size_t column, std::size_t row) const { return (joined_[at(column, row)] & east) != 0; }
  [[nodiscard]] bool joins_north(std::size_t column, std::size_t row) const { return (joined_[at(column, row)] & north) != 0; }
  /// Sides of pixels between two heights.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// How high each of these steps is. The raster is the same.
  [[nodiscard]] std::vector<double> heights_m(const TerrainRaster& raster) const;

  /// Leaves those squares to readers (PixelSquares) that are whole, not level, and lie within one cell of the grid, where
  /// `are_enough(count)`. Tells how many are left out. The raster is the same, and its pixels are squares.
  std::uint64_t leave_out_squares(const TerrainRaster& raster, const Grid& grid,
                                  const std::function<bool(std::uint64_t)>& are_enough);
  /// The square north-east of a pixel; none is left out beyond the raster.
  [[nodiscard]] bool is_left_out(std::size_t column, std::size_t row) const {
    return (joined_[at(column, row)] & PixelSquares::left_out) != 0;
  }
  /// JoinedPixels and PixelSquares of each pixel, row by row from the south.
  [[nodiscard]] std::span<const std::uint8_t> joined() const { return joined_; }

 private:
  static constexpr std::uint8_t east = JoinedPixels::east, north = JoinedPixels::north;
  [[nodiscard]] std::size_t at(std::size_t column, std::size_t row) const { return row * columns_ + column; }
  struct Line;
  void join(const TerrainRaster& raster, const Line& line);

  std::size_t columns_;
  std::vector<std::uint8_t> joined_;
  std::size_t count_ = 0;
};

/// Where the pixels of such a raster lie in a grid that is turned so.
[[nodiscard]] PixelsInGrid pixels_in_grid(const TerrainRaster& raster, const GridRotation& rotation);

}  // namespace farlod::tiles
