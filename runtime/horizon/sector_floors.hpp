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
struct SectorFloors {
  static constexpr std::size_t sectors = AzimuthRing::sectors, levels = std::bit_width(sectors);
  static_assert(std::has_single_bit(sectors));
  std::array<float, levels * sectors> lowest;
};

/// Of a row of slopes for each azimuth. A sector without azimuths has none to rise over.
FARLOD_LANES void find_floors(const float* slopes, const std::uint32_t* first_of_sector, SectorFloors& floors) {
  constexpr std::size_t sectors = SectorFloors::sectors;
  for (std::size_t s = 0; s < sectors; ++s) {
    Floats lowest = all(std::numeric_limits<float>::max());
    for (std::size_t k = first_of_sector[s]; k < first_of_sector[s + 1]; ++k)
      lowest = least(lowest, loaded(slopes + k * lane_count));
    floors.lowest[s] = least_lane(lowest);
  }
  for (std::size_t level = 1; level < SectorFloors::levels; ++level) {
    const std::size_t apart = std::size_t{1} << (level - 1);
    const float* half = &floors.lowest[(level - 1) * sectors];
    float* whole = &floors.lowest[level * sectors];
    for (std::size_t s = 0; s < sectors - apart; ++s) whole[s] = std::min(half[s], half[s + apart]);
    for (std::size_t s = sectors - apart; s < sectors; ++s) whole[s] = std::min(half[s], half[s + apart - sectors]);
  }
}

/// The largest whole number whose power of two is at most n ≥ 1.
FARLOD_LANES Wholes whole_logarithm(const Wholes& n) {
  const Floats value = __builtin_convertvector(n, Floats);
  Wholes bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits >> 23) - 127;
}

/// Writes the lanes of the edges that may rise over somebody's horizon, and returns how many there are.
FARLOD_LANES std::size_t find_risers(const EdgeReach& reach, const SectorFloors& floors,
                                     std::array<std::uint8_t, lane_count>& risers) {
  constexpr auto sectors = static_cast<std::int32_t>(SectorFloors::sectors);
  // What is said of edges too near to tell may lie anywhere
  const Wholes first = truncated(reach.from * static_cast<float>(sectors)),
               last = truncated(reach.to * static_cast<float>(sectors));
  const Wholes level = whole_logarithm(least(greatest(last - first + 1, Wholes{} + 1), Wholes{} + sectors));
  const Wholes begin = level * sectors + (first & (sectors - 1)),
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
