// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"

// Sky view factors above horizons, by quadrature in double.

namespace farlod {

/// What one azimuth gives, where the normal has the parts `outward` along it and `upward`, above a slope: cosine 2∫ n·d cos θ dθ,
/// solid angle ∫ cos θ dθ, over the elevations θ that are looked at and free. Simpson's rule with 200 intervals of at most π/400:
/// its error is below (π/400)⁴·(π/2)/180·16·2 < 2e-9.
[[nodiscard]] inline double expected_sky_of_azimuth(SkyWeight weight, double outward, double upward, double slope) {
  double from = std::atan(slope), to = 0.5 * std::numbers::pi;
  if (outward <= 0.0 && upward <= 0.0) return 0.0;
  if (outward < 0.0) from = std::max(from, std::atan2(-outward, upward));
  if (upward < 0.0) to = std::min(to, std::atan2(outward, -upward));
  if (from >= to) return 0.0;
  const auto seen = [&](double elevation) {
    const double along = std::cos(elevation);
    return weight == SkyWeight::cosine ? 2.0 * (outward * along + upward * std::sin(elevation)) * along : along;
  };
  constexpr int intervals = 200;
  const double step = (to - from) / intervals;
  double sum = seen(from) + seen(to);
  for (int n = 1; n < intervals; ++n) sum += (n % 2 == 1 ? 4.0 : 2.0) * seen(from + n * step);
  return sum * step / 3.0;
}
inline constexpr double quadrature_error = 2e-9;

/// The mean over the azimuths of a ring.
template <class SlopeAt>
[[nodiscard]] double expected_sky(SkyWeight weight, const Point3f& normal, const AzimuthSampling& ring, const SlopeAt& slope_at) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const double outward = double{normal.x} * double{ring.cosine()[k]} + double{normal.y} * double{ring.sine()[k]};
    sum += expected_sky_of_azimuth(weight, outward, normal.z, slope_at(k));
  }
  return std::clamp(sum / static_cast<double>(ring.size()), 0.0, 1.0);
}

/// What floats may be off: each azimuth gives at most 1 + π/2, by some thirty roundings of as much; adding them one by one rounds
/// each sum of a block of 256, and adding the blocks with compensation rounds twice. The slope at which a tilted receiver begins
/// or ceases to look, −outward/upward, is rounded with the reciprocal of the normal's rise.
[[nodiscard]] inline double sky_rounding(std::size_t azimuths, const Point3f& normal) {
  const double added = static_cast<double>(std::min<std::size_t>(azimuths, 256)) + 2.0;
  const double terms = (1.0 + 0.5 * std::numbers::pi) * (added + 30.0) * float_rounding;
  const double ends = normal.z != 0.0F ? 4.0 * float_rounding / std::abs(double{normal.z}) : 0.0;
  return terms + ends + quadrature_error;
}

}  // namespace farlod
