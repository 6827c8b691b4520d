// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

#include "farlod/point.hpp"

namespace farlod {

/// The shape that a crown fills evenly.
enum class CrownShape : std::uint8_t {
  spheroid,  ///< with a vertical axis
  cylinder,  ///< upright
  prism      ///< an upright square: a pixel of a canopy raster
};

inline constexpr std::size_t crown_shape_count = 3;

/// What winter does to a crown.
enum class Foliage : std::uint8_t { unknown, evergreen, deciduous };

/// A crown, as it is stored (crowns.bin) and computed with. A trunk is no part of it.
struct Crown {
  float x_m, y_m;         ///< of its axis: of its cell's frame where it is stored, elsewhere of a frame that is named
  float bottom_m, top_m;  ///< heights of that frame; bottom < top
  float half_width_m;     ///< radius of a spheroid or a cylinder, half of a square's edge; above 0
  CrownShape shape;
  Foliage foliage;
  /// Turn of the square of a prism, counter-clockwise, in 65536ths of a right angle. Other shapes have 0.
  std::uint16_t turn;

  [[nodiscard]] double turn_rad() const { return turn * (std::numbers::pi / 2.0 / 65536.0); }
  bool operator==(const Crown&) const = default;
};
static_assert(sizeof(Crown) == 24);

/// The same crown in a frame that lies `by` from where the crown's own frame does, in the plan: its place there is larger by it.
[[nodiscard]] inline Crown moved(Crown crown, Point2d by) {
  crown.x_m = static_cast<float>(static_cast<double>(crown.x_m) + by.x);
  crown.y_m = static_cast<float>(static_cast<double>(crown.y_m) + by.y);
  return crown;
}

}  // namespace farlod
