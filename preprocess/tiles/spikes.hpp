// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::tiles {

/// Files round to millimetres: the two legs of a spike differ by at most this along each axis.
inline constexpr double spike_width_m = 0.001;
/// A corner with a shorter leg may be a real one: rounding turns such a leg by up to a tenth of a radian.
inline constexpr double least_spike_m = 10.0 * spike_width_m;

/// A vertex at which a ring turns back along its last edge.
struct Spike {
  std::size_t vertex = 0;  ///< in the ring, counted from 0
  Point3d tip;
  double length_m = 0.0;  ///< of the shorter leg
};

struct DespikedRing {
  std::vector<Point3d> ring;
  std::vector<Spike> spikes;  ///< what was taken out
};

/// Removes the spikes of a ring. The result encloses the same area up to slivers of width `spike_width_m`. Nothing when there is
/// no spike, and when no area would remain.
[[nodiscard]] std::optional<DespikedRing> without_spikes(std::span<const Point3d> ring);

}  // namespace farlod::tiles
