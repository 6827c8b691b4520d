// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// Files round to millimetres: a way back that was the way there is off it by at most this, along each axis.
inline constexpr double spike_width_m = 0.001;
/// A corner with a shorter leg may be an honest one, bent by the rounding of its vertices by up to a tenth of a radian.
inline constexpr double least_spike_m = 10.0 * spike_width_m;

/// A vertex at which a ring turns back onto the way it came.
struct Spike {
  std::size_t vertex = 0;  ///< in the ring, counted from 0
  Point3d tip;
  double length_m = 0.0;  ///< of the way that is run there and back
};

struct DespikedRing {
  std::vector<Point3d> ring;
  std::vector<Spike> spikes;  ///< what was taken out
};

/// Takes the spikes out of a ring: what remains encloses the same area but for slivers of `spike_width_m`. Empty when there is
/// none, and when no area would remain.
[[nodiscard]] std::optional<DespikedRing> without_spikes(std::span<const Point3d> ring);

}  // namespace farlod
