// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"
#include "package/crown.hpp"
#include "package/crown_light.hpp"

// What crowns do to the sky, by rays in double that are clipped by solids: none of the formulas of runtime/canopy.

namespace farlod {

/// The part of a ray within a solid, from and to these distances.
using RayPart = std::pair<double, double>;
inline constexpr RayPart no_part{1.0, 0.0};

/// Where |origin + s direction| ≤ radius, of vectors of two or three coordinates.
template <std::size_t n>
[[nodiscard]] RayPart part_in_ball(const std::array<double, n>& origin, const std::array<double, n>& direction, double radius) {
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
[[nodiscard]] inline RayPart part_in_slab(double origin, double direction, double low, double high) {
  if (direction == 0.0) return low <= origin && origin <= high ? RayPart{-1e9, 1e9} : no_part;
  const double a = (low - origin) / direction, b = (high - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

[[nodiscard]] inline RayPart common_part(const RayPart& a, const RayPart& b) {
  return {std::max(a.first, b.first), std::min(a.second, b.second)};
}

/// The length of a ray, whose direction has length 1, in a crown.
[[nodiscard]] inline double length_in(const Crown& crown, const Point3d& eye, const Point3d& direction) {
  const double x = eye.x - double{crown.x_m}, y = eye.y - double{crown.y_m}, a = crown.half_width_m;
  const double half_height = 0.5 * (double{crown.top_m} - double{crown.bottom_m});
  const RayPart ahead{0.0, std::numeric_limits<double>::max()};
  RayPart part = part_in_slab(eye.z, direction.z, crown.bottom_m, crown.top_m);
  if (crown.shape == CrownShape::spheroid) {
    const double stretch = a / half_height, z = (eye.z - double{crown.bottom_m} - half_height) * stretch;
    part = part_in_ball<3>({x, y, z}, {direction.x, direction.y, direction.z * stretch}, a);
  } else if (crown.shape == CrownShape::cylinder) {
    // A ray straight up meets its plan everywhere or nowhere
    part = common_part(part, part_in_ball<2>({x, y}, {direction.x, direction.y}, a));
  } else {
    const double c = std::cos(crown.turn_rad()), s = std::sin(crown.turn_rad());
    part = common_part(part, part_in_slab(c * x + s * y, c * direction.x + s * direction.y, -a, a));
    part = common_part(part, part_in_slab(c * y - s * x, c * direction.y - s * direction.x, -a, a));
  }
  part = common_part(part, ahead);
  return std::max(0.0, part.second - part.first);
}

/// The share of the light that passes all crowns along a ray, and whether it meets any.
struct Passed {
  double light = 1.0;
  bool meets = false;
};
[[nodiscard]] inline Passed passed(std::span<const Crown> crowns, const CanopySettings& settings, const Point3d& eye,
                                   const Point3d& direction) {
  Passed result;
  for (const Crown& crown : crowns) {
    const double length = length_in(crown, eye, direction);
    if (length <= 0.0) continue;
    result.meets = true;
    const double psi = transmissivity_of(crown.foliage, settings);
    if (settings.rule == CanopyRule::once) result.light = std::min(result.light, psi);
    if (settings.rule == CanopyRule::each) result.light *= psi;
    if (settings.rule == CanopyRule::beer) result.light *= std::exp(-extinction_per_m_of(crown.foliage, settings) * length);
  }
  return result;
}

/// Shares of the sky as CanopyShares has them, and that of the profile. The error is that of the rule of the middle for what
/// varies by V along the elevation: V/2 of a step, by the proof of docs/concepts.md, "The error of K azimuths". Twice that, since
/// V is what the rays show of it.
struct JudgedShares {
  double lost = 0.0, behind = 0.0, sky = 0.0, error = 0.0;
};

/// By rays at the azimuths of a sampling and in the middles of `steps` equal parts of the elevation, for the sky above `sky_from`
/// and in gaps.
[[nodiscard]] inline JudgedShares judged_shares(std::span<const Crown> crowns, const CanopySettings& settings,
                                                const AzimuthSampling& azimuths, const SkyProfile& profile,
                                                const ReceiverPacket& receivers, std::size_t lane, int steps) {
  const Point3d eye{receivers.x[lane], receivers.y[lane], receivers.z[lane]};
  const Point3d normal{receivers.normal_x[lane], receivers.normal_y[lane], receivers.normal_z[lane]};
  const double step = 0.5 * std::numbers::pi / steps;
  JudgedShares sums;
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    double lost_before = 0.0, behind_before = 0.0, variation = 0.0;
    for (int n = 0; n < steps; ++n) {
      const double elevation = (n + 0.5) * step, across = std::cos(elevation), slope = std::tan(elevation);
      double share = slope > double{profile.sky_from[k][lane]} ? 1.0 : 0.0;
      if (!profile.gap_share.empty() && slope > double{profile.gap_from[k][lane]} && slope < double{profile.gap_to[k][lane]})
        share += double{profile.gap_share[k][lane]};
      const Point3d d{across * double{azimuths.cosine()[k]}, across * double{azimuths.sine()[k]}, std::sin(elevation)};
      const double weight = 2.0 * step * across * share * std::max(0.0, d.x * normal.x + d.y * normal.y + d.z * normal.z);
      const Passed p = weight == 0.0 ? Passed{} : passed(crowns, settings, eye, d);
      const double lost = weight * (1.0 - p.light), behind = p.meets ? weight : 0.0;
      sums.sky += weight;
      sums.lost += lost;
      sums.behind += behind;
      variation += std::max(std::abs(lost - lost_before), std::abs(behind - behind_before));
      lost_before = lost;
      behind_before = behind;
    }
    sums.error += variation + behind_before;
  }
  const auto count = static_cast<double>(azimuths.size());
  return {sums.lost / count, sums.behind / count, sums.sky / count, sums.error / count};
}

}  // namespace farlod
