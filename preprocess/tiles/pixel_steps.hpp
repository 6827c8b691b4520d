// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "city/city_model.hpp"

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

 private:
  static constexpr std::uint8_t east = 1, north = 2;
  [[nodiscard]] std::size_t at(std::size_t column, std::size_t row) const { return row * columns_ + column; }
  struct Line;
  void join(const TerrainRaster& raster, const Line& line);

  std::size_t columns_;
  std::vector<std::uint8_t> joined_;
  std::size_t count_ = 0;
};

}  // namespace farlod::tiles
