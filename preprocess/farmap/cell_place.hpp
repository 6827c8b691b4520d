// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "farlod/box.hpp"
#include "farlod/far_map/receiver_patches.hpp"
#include "farlod/grid.hpp"

namespace farlod {

/// A cell whose far map is baked: where it lies in the frame of CityHorizon, and where its receivers may be.
struct CellPlace {
  Point2d corner;
  CellRange near;
  Box2d square;  ///< cell frame
  ReceiverPatches patches;

  /// The level at which a layer ends; the uppermost has none but its floor.
  [[nodiscard]] std::uint32_t ceiling_level(std::uint32_t layer) const { return std::min(layer + 1, patches.layers() - 1); }
};

[[nodiscard]] inline double sine_of_slope(double slope) { return slope / std::sqrt(1.0 + slope * slope); }
/// Infinite for sines that no slope reaches.
[[nodiscard]] inline double slope_of_sine(double sine) {
  return sine < 1.0 ? sine / std::sqrt(1.0 - sine * sine) : std::numeric_limits<double>::infinity();
}

}  // namespace farlod
