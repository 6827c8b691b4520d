// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>

#include "canopy/crown_sections.hpp"
#include "horizon/lanes.hpp"

/// The union of the slopes that crowns cover at an azimuth, for sixteen receivers.
namespace farlod {

/// An interval that is none: it begins above all slopes, and ends below.
inline constexpr float none_low = 1e30F, none_high = -1.0F;

/// What is hidden or behind crowns at an azimuth: slopes up to `ground`, which is the horizon and what has been joined to it; the
/// core, from core_low to core_high; and the intervals of a list, which touch neither. Which of these holds an interval changes
/// no sum, which is taken over the whole union.
struct CrownUnion {
  Floats ground, core_low = broadcast(none_low), core_high = broadcast(none_high);
  float *low, *high;  ///< rows of the list, the first of which is free
  std::size_t count = 1;

  FARLOD_LANES void join(const CutCrown& cut) {
    // Below the ground for all receivers, or not met
    if (bits_of(cut.high > ground) == 0) return;
    // The ground rises to intervals that begin in it
    const Mask is_apart = cut.low > ground;
    ground = max(ground, choose(is_apart, broadcast(none_high), cut.high));
    const Floats width = choose(is_apart, cut.high - cut.low, broadcast(-1.0F));
    if (bits_of(width > 0.0F) != 0) join_above(cut, width);
  }

  /// The core grows to intervals above the ground that touch it, and begins with the first. Then so does the last interval of the
  /// list, since crowns beside each other come one after the other; what touches neither is appended.
  FARLOD_LANES void join_above(const CutCrown& cut, const Floats& width) {
    const Floats left = grow(cut, width, core_low, core_high);
    if (bits_of(left > 0.0F) != 0) join_list(cut, left);
  }
  FARLOD_LANES void join_list(const CutCrown& cut, const Floats& width) {
    Floats left = width;
    if (count > 1) {
      Floats last_low = load(low + (count - 1) * lane_count), last_high = load(high + (count - 1) * lane_count);
      left = grow(cut, width, last_low, last_high);
      store(last_low, low + (count - 1) * lane_count);
      store(last_high, high + (count - 1) * lane_count);
      if (bits_of(left > 0.0F) == 0) return;
    }
    const Mask is_left = left > 0.0F;
    store(choose(is_left, cut.low, broadcast(-none_low)), low + count * lane_count);
    store(choose(is_left, cut.high, broadcast(none_high)), high + count * lane_count);
    ++count;
  }
  /// Returns the widths of what does not touch the interval, which may be none.
  FARLOD_LANES static Floats grow(const CutCrown& cut, const Floats& width, Floats& from, Floats& to) {
    const Mask is_none = to < 0.0F;
    const Floats low_end = choose(is_none, cut.low, from), high_end = choose(is_none, cut.high, to);
    const Floats overlap = min(high_end - cut.low, cut.high - low_end);
    const Mask joins = choose(width > 0.0F, overlap, broadcast(-1.0F)) >= 0.0F;
    from = choose(joins, min(low_end, cut.low), from);
    to = choose(joins, max(high_end, cut.high), to);
    return choose(joins, broadcast(-1.0F), width);
  }
};

/// Puts the upper interval of two before the lower one, for each receiver.
FARLOD_LANES void order_two(float* low, float* high, std::size_t first, std::size_t second) {
  const Floats low_a = load(low + first * lane_count), low_b = load(low + second * lane_count);
  const Floats high_a = load(high + first * lane_count), high_b = load(high + second * lane_count);
  const Mask swaps = low_a < low_b;
  store(choose(swaps, low_b, low_a), low + first * lane_count);
  store(choose(swaps, high_b, high_a), high + first * lane_count);
  store(choose(swaps, low_a, low_b), low + second * lane_count);
  store(choose(swaps, high_a, high_b), high + second * lane_count);
}

/// Sorts the intervals of each receiver by their lower ends, from high to low: Batcher's merge exchange, whose steps depend on
/// the number of intervals alone.
FARLOD_LANES void sort_intervals(float* low, float* high, std::size_t count) {
  if (count < 2) return;
  const std::size_t largest = std::bit_ceil(count) / 2;
  for (std::size_t p = largest; p > 0; p /= 2) {
    std::size_t q = largest, r = 0;
    for (std::size_t apart = p; apart > 0; apart = q - p, q /= 2, r = p) {
      for (std::size_t n = 0; n + apart < count; ++n)
        if ((n & p) == r) order_two(low, high, n, n + apart);
    }
  }
}

/// Calls `visit(from, to, ends)` for each of the maximal intervals that make a union up, from the ground on: it ends in these
/// lanes.
template <class Visit>
FARLOD_LANES void for_each_run(const CrownUnion& u, const Visit& visit) {
  // The core is the first interval of the list
  store(u.core_low, u.low);
  store(u.core_high, u.high);
  sort_intervals(u.low, u.high, u.count);
  // A run of intervals that touch each other, from the ground on
  Floats from = broadcast(-1.0F), to = u.ground;
  for (std::size_t n = u.count + 1; n-- > 0;) {
    // Beyond the last, the run ends in all lanes
    const Floats next_low = n > 0 ? load(u.low + (n - 1) * lane_count) : broadcast(none_low);
    const Mask opens = next_low > to;
    if (bits_of(opens) != 0) {
      visit(from, to, opens);
      from = choose(opens, next_low, from);
    }
    if (n > 0) to = max(choose(opens, load(u.high + (n - 1) * lane_count), to), load(u.high + (n - 1) * lane_count));
  }
}

}  // namespace farlod
