// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "farlod/canopy.hpp"
#include "package/crown.hpp"

namespace farlod {

[[nodiscard]] inline CanopySettings settings_of(CanopyRule rule, std::optional<double> transmissivity = {},
                                                double extinction_per_m = 0.6, Season season = Season::leaf_on) {
  return {rule, season, transmissivity, extinction_per_m};
}

/// A crown around (x, y), by the heights of its bottom and its top.
struct Heights {
  double bottom_m, top_m;
};
[[nodiscard]] inline Crown crown_at(CrownShape shape, Point2d axis, double half_width_m, Heights heights,
                                    Foliage foliage = Foliage::unknown, std::uint16_t turn = 0) {
  return {static_cast<float>(axis.x),
          static_cast<float>(axis.y),
          static_cast<float>(heights.bottom_m),
          static_cast<float>(heights.top_m),
          static_cast<float>(half_width_m),
          shape,
          foliage,
          turn};
}

/// 2 E₃(τ): what an endless layer of optical depth τ leaves of the sky.
[[nodiscard]] inline double layer_light(double depth) {
  const double e1 = -std::expint(-depth), e2 = std::exp(-depth) - depth * e1;
  return std::exp(-depth) - depth * e2;
}

}  // namespace farlod
