// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "canopy/crown_kernels.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

/// The sky between slopes, for kernels that add up what crowns hide of it.
namespace farlod {

/// What normals that all point straight up see at an azimuth: A(t) = 1 / (1 + t²).
struct SkyStraightUp {
  // Members as SkyOfNormals has them. NOLINTBEGIN(readability-convert-member-functions-to-static)
  FARLOD_LANES SlopeInterval in_front() const { return {broadcast(0.0F), broadcast(straight_up)}; }
  /// A(t) − A(s), which loses nothing to rounding where both are near each other.
  FARLOD_LANES Floats between(const Floats& t, const Floats& s) const {
    const Floats t_square = t * t, s_square = s * s;
    return (s_square - t_square) / ((1.0F + t_square) * (1.0F + s_square));
  }
  /// −dA/dy of y = sin²θ, at the slope t.
  FARLOD_LANES Floats density(const Floats&) const { return broadcast(1.0F); }
  // NOLINTEND(readability-convert-member-functions-to-static)
};

/// What any normals see at an azimuth.
struct SkyOfNormals {
  Floats outward, upward;
  FARLOD_LANES SlopeInterval in_front() const { return slopes_in_front(outward, upward); }
  FARLOD_LANES Floats between(const Floats& t, const Floats& s) const {
    return max(cosine_above(t, outward, upward) - cosine_above(s, outward, upward), broadcast(0.0F));
  }
  FARLOD_LANES Floats density(const Floats& t) const { return max(upward + outward / t, broadcast(0.0F)); }
};

template <class Sky>
FARLOD_LANES Sky sky_at(const Normals& normals, float cosine, float sine);
template <>
FARLOD_LANES SkyStraightUp sky_at(const Normals&, float, float) {
  return {};
}
template <>
FARLOD_LANES SkyOfNormals sky_at(const Normals& n, float cosine, float sine) {
  return {n.x * cosine + n.y * sine, n.z};
}

/// Some slopes of an azimuth of which receivers see a share: the sky above the horizon, or a gap.
struct SkyWindow {
  Floats from, to, weight;
};

/// Where the sky above the horizon begins.
FARLOD_LANES Floats begin_above(const SkyRows& rows, std::size_t k, const SlopeInterval& in_front) {
  return min(max(load(rows.sky_from + k * lane_count), in_front.lowest), in_front.highest);
}

/// The sky above the horizon. Its weight makes what is above the horizon's slope as much as what the jumps leave of it.
template <class Sky>
FARLOD_LANES SkyWindow window_above(const SkyRows& rows, std::size_t k, const Sky& sky) {
  const SlopeInterval in_front = sky.in_front();
  const Floats from = begin_above(rows, k, in_front);
  if (rows.sky == nullptr) return {from, in_front.highest, broadcast(1.0F)};
  const Floats all = sky.between(from, in_front.highest), known = load(rows.sky + k * lane_count);
  const Mask is_some = all > 0.0F;
  return {from, in_front.highest, choose(is_some, known / choose(is_some, all, broadcast(1.0F)), broadcast(0.0F))};
}

/// A gap, of whose sky a share is seen: the same share of what crowns take of it.
template <class Sky>
FARLOD_LANES SkyWindow window_of_gap(const SkyRows& rows, std::size_t k, const Sky& sky) {
  const SlopeInterval in_front = sky.in_front();
  const Floats share = load(rows.gap_share + k * lane_count);
  const Floats from = min(max(load(rows.gap_from + k * lane_count), in_front.lowest), in_front.highest),
               to = min(max(load(rows.gap_to + k * lane_count), from), in_front.highest);
  return {from, choose(share > 0.0F, to, from), share};
}

/// Where sky begins that counts: above the horizon, or in a gap below it.
FARLOD_LANES Floats ground_of(const Floats& above, const SkyWindow& gap) {
  return choose(gap.to > gap.from, min(gap.from, above), above);
}

/// The sky of a window between the slopes low and high, as weighted.
template <class Sky>
FARLOD_LANES Floats sky_within(const SkyWindow& window, const Sky& sky, const Floats& low, const Floats& high) {
  const Floats from = min(max(low, window.from), window.to), to = min(max(high, from), window.to);
  if (bits_of(to > from) == 0) return Floats{};
  return choose(to > from, window.weight * sky.between(from, to), broadcast(0.0F));
}

}  // namespace farlod
