// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "farlod/point.hpp"

namespace farlod::package {

/// A direction in 44 bits: where it meets the octahedron |x| + |y| + |z| = 1, whose lower half is folded outwards, so that both
/// halves together fill the square of the x and y from −1 to 1. Any two numbers of 22 bits are a direction. The six directions
/// along the axes come back exactly, horizontal ones exactly horizontal; what looks up never comes back looking down.
struct OctNormal {
  static constexpr std::uint32_t bits = 22;
  static constexpr std::uint32_t largest = (1U << bits) - 1;
  /// Number of steps of u and v on either side of the middle.
  static constexpr std::int32_t steps = largest / 2;
  /// Between a direction and what comes back: half a diagonal of a step of u and v, which is up to √3 times as long on the
  /// octahedron, whose faces are tilted, and again as far seen from its centre, which is 1/√3 away.
  static constexpr double largest_error_rad = 3.0 * 0.5 * std::numbers::sqrt2 / steps;

  std::uint32_t u = steps, v = steps;  ///< 0 to 2 · steps
  bool operator==(const OctNormal&) const = default;

  /// Nearest to a direction of any length; upwards, where there is none.
  [[nodiscard]] static OctNormal nearest_to(const Point3d& direction) {
    const double size = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(size > 0.0)) return {};
    double u = direction.x / size, v = direction.y / size;
    if (direction.z < 0.0) {
      const double folded = std::copysign(1.0 - std::abs(v), u);
      v = std::copysign(1.0 - std::abs(u), v);
      u = folded;
    }
    return nearest_corner(steps * u, steps * v, direction);
  }

  /// The direction, of length 1.
  [[nodiscard]] Point3f direction() const {
    const Point3d d = normalized(on_octahedron());
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
  }
  /// Whether `direction().z` is positive.
  [[nodiscard]] bool looks_up() const { return std::abs(from_middle(u)) + std::abs(from_middle(v)) < steps; }

 private:
  [[nodiscard]] static std::int32_t from_middle(std::uint32_t u_or_v) { return static_cast<std::int32_t>(u_or_v) - steps; }

  /// In steps.
  [[nodiscard]] Point3d on_octahedron() const {
    const double x = from_middle(u), y = from_middle(v), z = steps - std::abs(x) - std::abs(y);
    if (z >= 0.0) return {x, y, z};
    return {x < 0.0 ? std::abs(y) - steps : steps - std::abs(y), y < 0.0 ? std::abs(x) - steps : steps - std::abs(x), z};
  }

  /// The corners around a place fold differently: which one is the nearest shows only on the sphere.
  [[nodiscard]] static OctNormal nearest_corner(double u_steps, double v_steps, const Point3d& direction) {
    OctNormal nearest;
    double most_alike = -std::numeric_limits<double>::infinity();
    for (const double u : {std::floor(u_steps), std::ceil(u_steps)})
      for (const double v : {std::floor(v_steps), std::ceil(v_steps)}) {
        const OctNormal corner{static_cast<std::uint32_t>(u + steps), static_cast<std::uint32_t>(v + steps)};
        const double alike = dot(normalized(corner.on_octahedron()), direction);
        if (alike <= most_alike) continue;
        most_alike = alike;
        nearest = corner;
      }
    return nearest;
  }
};

}  // namespace farlod::package
