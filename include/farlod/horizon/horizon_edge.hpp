// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "farlod/point.hpp"

namespace farlod {

/// How steeply the solid rises away from an edge, at right angles to it, to the left and to the right of the way from its first
/// end to its second, seen from above. Rounded down, to 127ths of a right angle.
struct EdgeRises {
  static constexpr std::int8_t straight_down = -127;  ///< a wall, or unknown: it hides nothing of the edge
  std::int8_t left = straight_down, right = straight_down;
  bool operator==(const EdgeRises&) const = default;

  [[nodiscard]] static std::int8_t rounded_down(double rise_rad) {
    const double steps = std::floor(rise_rad / (0.5 * std::numbers::pi) * 127.0);
    return static_cast<std::int8_t>(std::clamp(steps, -127.0, 127.0));
  }
  /// The tangent of the angle; beyond all slopes of a city where that is straight down or up.
  [[nodiscard]] static double slope(std::int8_t rise) {
    static const std::array<double, 255> slopes = [] {
      std::array<double, 255> all{};
      for (int steps = -127; steps <= 127; ++steps)
        all[static_cast<std::size_t>(steps + 127)] = std::tan(0.5 * std::numbers::pi / 127.0 * steps);
      return all;
    }();
    return slopes[static_cast<std::size_t>(std::max<int>(rise, -127) + 127)];
  }
};

/// An edge of the city below which everything is solid, down to the ground: whoever looks below it sees no sky. Where the whole
/// city stands so, the horizon of a receiver is the upper envelope of these edges.
struct HorizonEdge {
  Point3f a, b;
  EdgeRises rises{};
  std::uint16_t reserved = 0;
  bool operator==(const HorizonEdge&) const = default;
};
static_assert(sizeof(HorizonEdge) == 28);

}  // namespace farlod
