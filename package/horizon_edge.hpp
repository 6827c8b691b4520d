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

/// The angles at which the solid rises away from an edge: at right angles to the edge, to the left and to the right of the way
/// from its first end to its second, seen from above. In 127ths of a right angle, rounded down (of lower borders, up).
struct AdjacentSlopes {
  static constexpr std::int8_t straight_down = -127;  ///< a wall, or unknown: it hides nothing of the edge
  static constexpr std::int8_t straight_up = 127;     ///< the same for the lower border of something
  std::int8_t left = straight_down, right = straight_down;
  bool operator==(const AdjacentSlopes&) const = default;

  [[nodiscard]] static std::int8_t rounded_down(double rise_rad) {
    const double steps = std::floor(rise_rad / (0.5 * std::numbers::pi) * 127.0);
    return static_cast<std::int8_t>(std::clamp(steps, -127.0, 127.0));
  }
  [[nodiscard]] static std::int8_t rounded_up(double rise_rad) {
    const double steps = std::ceil(rise_rad / (0.5 * std::numbers::pi) * 127.0);
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

/// A facet that leans out by no more than this over its height, an error of surveys, counts as vertical: no lower border tells
/// that sky may be seen below its top. Its receivers therefore stand ahead of its top.
inline constexpr double max_lean_m = 0.05;

/// What an edge says about the sky below it. In the upright half-plane of an azimuth, a connected piece of the city hides all
/// slopes between its lowest and its highest one. Proof and use: docs/concepts.md, "What is grounded, and what overhangs".
enum class EdgeRole : std::uint16_t {
  grounded = 0,   ///< an upper border: everything below it is hidden, down to the ground
  overhang = 1,   ///< an upper border of something that may be seen under
  underside = 2,  ///< a lower border of such a thing: sky may be seen below it
};
inline constexpr std::size_t edge_role_count = 3;

/// An edge of the city that can be a silhouette. The upper envelope of `grounded` and `overhang` edges is a receiver's horizon;
/// above the upper envelope of the `underside` edges, nothing floats.
/// `adjacent` is that of the steepest facets beside an upper border, and of the flattest ones beside a lower border; there,
/// AdjacentSlopes::straight_up stands for a wall or for none.
struct HorizonEdge {
  Point3f a, b;
  AdjacentSlopes adjacent{};
  EdgeRole role = EdgeRole::grounded;
  bool operator==(const HorizonEdge&) const = default;
};
static_assert(sizeof(HorizonEdge) == 28);

}  // namespace farlod
