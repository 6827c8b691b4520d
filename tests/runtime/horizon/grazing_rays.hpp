// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Two ways of seeing may differ by this angle: coordinates below 128 m are rounded by 2⁻¹⁷ m = 8 µm, 1.6e-5 rad from half a
/// metre away; azimuths and slopes by 4e-6 rad; and an edge that is seen end-on within 1e-5 rad may be left out.
inline constexpr float grazing_rad = 4e-5F;

/// Whether rays meet something, and whether turning them by that angle, four ways, would change it.
struct RayVerdict {
  bool is_free = false, grazes = false;
};

[[nodiscard]] inline RayVerdict verdict(const Occluder& city, const Point3f& origin, const Point3f& d) {
  const Point3f aside = std::abs(d.z) < 0.9F ? Point3f{0.0F, 0.0F, 1.0F} : Point3f{1.0F, 0.0F, 0.0F};
  const Point3f u = normalized(cross(d, aside)), v = cross(d, u);
  const auto is_free = [&](const Point3f& direction) { return !city.blocks({origin, direction, least_distance_m}); };
  RayVerdict result{is_free(d), false};
  for (const Point3f& turn : {u, v})
    for (const float angle : {grazing_rad, -grazing_rad}) result.grazes |= is_free(d + angle * turn) != result.is_free;
  return result;
}

}  // namespace farlod
