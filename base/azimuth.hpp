// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "farlod/point.hpp"

namespace farlod {

/// The full turn, cut into equal bins: bin k holds the azimuths from k·width to (k + 1)·width, counter-clockwise from the x axis.
struct AzimuthBins {
  std::uint32_t count = 256;

  [[nodiscard]] double width_rad() const { return 2.0 * std::numbers::pi / count; }
  /// The bin itself of one that was counted on for any number of turns, or back.
  [[nodiscard]] std::uint32_t wrapped(std::int64_t bin) const {
    const std::int64_t n = count;
    return static_cast<std::uint32_t>(((bin % n) + n) % n);
  }
  [[nodiscard]] std::uint32_t bin_of(Point2d direction) const {
    const double azimuth_rad = std::atan2(direction.y, direction.x);
    return wrapped(static_cast<std::int64_t>(std::floor(azimuth_rad / width_rad())));
  }
};

/// Pseudo-angle of a direction, in turns: 0 to 1, counter-clockwise from the x axis. It grows with the azimuth and needs no arc
/// tangent: it is the length along the perimeter of the square |x| + |y| = 1, as a fraction of the whole. Opposite directions are
/// half a turn apart. Its derivative by the azimuth lies between 1/8 and 1/4 of a turn per radian.
[[nodiscard]] inline double pseudo_angle(Point2d d) {
  const double across = 0.25 * d.y / (std::abs(d.x) + std::abs(d.y));
  if (d.x < 0.0) return 0.5 - across;
  return d.y < 0.0 ? 1.0 + across : across;
}

}  // namespace farlod
