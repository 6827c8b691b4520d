// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "horizon/azimuth_ring.hpp"
#include "horizon/edge_reach.hpp"
#include "horizon/lanes.hpp"

namespace farlod {

/// The lowest slope of any receiver's horizon in 1, 2, 4 … 64 sectors from each on, over the end of the turn: two of them tell
/// the lowest of any stretch of sectors.
struct SectorMinHorizon {
  static constexpr std::size_t sectors = AzimuthRing::sectors, levels = std::bit_width(sectors);
  static_assert(std::has_single_bit(sectors));
  std::array<float, levels * sectors> lowest;
};

/// Of a row of slopes for each azimuth. A sector without azimuths has none to rise over.
FARLOD_LANES void find_sector_minima(const float* slopes, const std::uint32_t* first_of_sector, SectorMinHorizon& floors) {
  constexpr std::size_t sectors = SectorMinHorizon::sectors;
  for (std::size_t s = 0; s < sectors; ++s) {
    Floats lowest = broadcast(std::numeric_limits<float>::max());
    for (std::size_t k = first_of_sector[s]; k < first_of_sector[s + 1]; ++k)
      lowest = min(lowest, load(slopes + k * lane_count));
    floors.lowest[s] = min_lane(lowest);
  }
  for (std::size_t level = 1; level < SectorMinHorizon::levels; ++level) {
    const std::size_t apart = std::size_t{1} << (level - 1);
    const float* half = &floors.lowest[(level - 1) * sectors];
    float* whole = &floors.lowest[level * sectors];
    for (std::size_t s = 0; s < sectors - apart; ++s) whole[s] = std::min(half[s], half[s + apart]);
    for (std::size_t s = sectors - apart; s < sectors; ++s) whole[s] = std::min(half[s], half[s + apart - sectors]);
  }
}

/// The largest whole number whose power of two is at most n ≥ 1.
FARLOD_LANES Ints floor_log2(const Ints& n) {
  const Floats value = __builtin_convertvector(n, Floats);
  Ints bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits >> 23) - 127;
}

/// Writes the lanes of the edges that may rise over somebody's horizon, and returns how many there are.
FARLOD_LANES std::size_t edges_above_horizon(const EdgeReach& reach, const SectorMinHorizon& floors,
                                     std::array<std::uint8_t, lane_count>& risers) {
  constexpr auto sectors = static_cast<std::int32_t>(SectorMinHorizon::sectors);
  // What is said of edges too near to tell may lie anywhere
  const Ints first = truncate(reach.from * static_cast<float>(sectors)),
               last = truncate(reach.to * static_cast<float>(sectors));
  const Ints level = floor_log2(min(max(last - first + 1, Ints{} + 1), Ints{} + sectors));
  const Ints begin = level * sectors + (first & (sectors - 1)),
               end = level * sectors + ((last + 1 - (1 << level)) & (sectors - 1));
  std::size_t count = 0;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const auto floor_at = [&floors](std::int32_t n) __attribute__((always_inline)) {
      return floors.lowest[static_cast<std::size_t>(n)];
    };
    const float floor = std::min(floor_at(begin[l]), floor_at(end[l]));
    risers[count] = static_cast<std::uint8_t>(l);
    count += static_cast<std::size_t>(reach.steepest[l] > floor);
  }
  return count;
}

}  // namespace farlod
