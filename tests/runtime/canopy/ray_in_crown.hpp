// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "farlod/point.hpp"
#include "package/crown.hpp"

// Rays in double that are clipped by solids: none of the formulas of runtime/canopy and runtime/occlusion.

namespace farlod {

/// The part of a ray within a solid, from and to these distances.
using RayPart = std::pair<double, double>;
inline constexpr RayPart no_part{1.0, 0.0};

/// Where |origin + s direction| ≤ radius, of vectors of two or three coordinates.
template <std::size_t n>
RayPart part_in_ball(const std::array<double, n>& origin, const std::array<double, n>& direction, double radius) {
  double dd = 0.0, od = 0.0, oo = -radius * radius;
  for (std::size_t i = 0; i < n; ++i) {
    dd += direction[i] * direction[i];
    od += origin[i] * direction[i];
    oo += origin[i] * origin[i];
  }
  const double square = od * od - dd * oo;
  if (square <= 0.0) return no_part;
  return {(-od - std::sqrt(square)) / dd, (-od + std::sqrt(square)) / dd};
}

/// Where low ≤ origin + s direction ≤ high.
inline RayPart part_in_slab(double origin, double direction, double low, double high) {
  if (direction == 0.0) return low <= origin && origin <= high ? RayPart{-1e9, 1e9} : no_part;
  const double a = (low - origin) / direction, b = (high - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

inline RayPart common_part(const RayPart& a, const RayPart& b) {
  return {std::max(a.first, b.first), std::min(a.second, b.second)};
}

/// Where origin + s direction lies in a crown.
inline RayPart part_in_crown(const Crown& crown, const Point3d& origin, const Point3d& direction) {
  const double x = origin.x - double{crown.x_m}, y = origin.y - double{crown.y_m}, a = crown.half_width_m;
  const double half_height = 0.5 * (double{crown.top_m} - double{crown.bottom_m});
  if (crown.shape == CrownShape::spheroid) {
    const double stretch = a / half_height, z = (origin.z - double{crown.bottom_m} - half_height) * stretch;
    return part_in_ball<3>({x, y, z}, {direction.x, direction.y, direction.z * stretch}, a);
  }
  const RayPart part = part_in_slab(origin.z, direction.z, crown.bottom_m, crown.top_m);
  // A ray straight up meets its plan everywhere or nowhere
  if (crown.shape == CrownShape::cylinder) return common_part(part, part_in_ball<2>({x, y}, {direction.x, direction.y}, a));
  const double c = std::cos(crown.turn_rad()), s = std::sin(crown.turn_rad());
  return common_part(part, common_part(part_in_slab(c * x + s * y, c * direction.x + s * direction.y, -a, a),
                                       part_in_slab(c * y - s * x, c * direction.y - s * direction.x, -a, a)));
}

}  // namespace farlod
