// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "farlod/canopy.hpp"
#include "package/crown.hpp"

namespace farlod {

[[nodiscard]] inline CanopySettings settings_of(CanopyRule rule, std::optional<double> transmissivity = {},
                                                double extinction_per_m = 0.6, Season season = Season::leaf_on) {
  return {rule, season, transmissivity, extinction_per_m};
}

[[nodiscard]] inline Crown crown_of(CrownShape shape, Point2d axis_m, double bottom_m, double top_m, double half_width_m,
                                    Foliage foliage = Foliage::unknown, std::uint16_t turn = 0) {
  return {static_cast<float>(axis_m.x),
          static_cast<float>(axis_m.y),
          static_cast<float>(bottom_m),
          static_cast<float>(top_m),
          static_cast<float>(half_width_m),
          shape,
          foliage,
          turn};
}

}  // namespace farlod
