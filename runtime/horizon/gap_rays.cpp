// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_rays.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "horizon/lanes.hpp"

namespace farlod {
namespace {

using Lanes = PacketHorizon::Lanes;

/// Rays of neighbouring azimuths pass at other heights: fractions of the multiples of the golden ratio spread evenly.
float offset_of(std::size_t azimuth) {
  constexpr double golden = 0.61803398874989485;
  const double multiple = golden * static_cast<double>(azimuth);
  return static_cast<float>(multiple - std::floor(multiple));
}

/// The share of the sky above slopes, cosine-weighted: rays are spread evenly over it.
FARLOD_FOR_EACH_PROCESSOR
void find_shares_above(const float* slopes, float* shares) {
  const Floats t = loaded(slopes);
  store(1.0F / (1.0F + t * t), shares);
}

/// The slopes above which so much of the sky lies, on the way from one share to another.
FARLOD_FOR_EACH_PROCESSOR
void find_slopes(const float* from_share, const float* to_share, float place, float* slopes) {
  const Floats from = loaded(from_share), share = from + place * (loaded(to_share) - from);
  store(root(greatest(1.0F / share - 1.0F, all(0.0F))), slopes);
}

/// A bit for each receiver whose direction passes where nothing is seen.
std::uint32_t filled(const Gaps& gaps, std::size_t azimuth, const Lanes& slopes) {
  const PacketHorizon::Row &from = gaps.filled_from.row(azimuth), &to = gaps.filled_to.row(azimuth);
  std::uint32_t bits = 0;
  for (std::size_t l = 0; l < slopes.size(); ++l) bits |= slopes[l] >= from[l] && slopes[l] < to[l] ? 1U << l : 0U;
  return bits;
}

/// A gap that takes a larger share of what an azimuth can see gets more rays.
std::size_t rays_in(float share, std::size_t rays_per_azimuth) {
  const float wanted = std::ceil(share * static_cast<float>(rays_per_azimuth));
  return static_cast<std::size_t>(std::max(1.0F, wanted));
}

}  // namespace

float close_smallest(std::span<PacketHorizon::Row> sky, std::size_t lane, float most) {
  std::vector<float> sizes;
  for (const PacketHorizon::Row& row : sky)
    if (row[lane] > 0.0F) sizes.push_back(row[lane]);
  std::sort(sizes.begin(), sizes.end());
  float sum = 0.0F, largest = 0.0F;
  for (const float size : sizes) {
    if (sum + size > most) break;
    sum += size;
    largest = size;
  }
  // Of several of that size, the last may be too many
  float closed = 0.0F;
  for (PacketHorizon::Row& row : sky)
    if (row[lane] <= largest && closed + row[lane] <= most) closed += std::exchange(row[lane], 0.0F);
  return closed;
}

Lanes trace_gaps(const Gaps& gaps, const AzimuthRing& ring, SkyWeight weight, const ReceiverPacket& receivers,
                 std::uint32_t wanted, std::size_t rays_per_azimuth, const PlacedScene& scene) {
  const RayOrigins origins = scene.origins_of(receivers);
  Lanes seen{};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    // Who has a gap here
    const PacketHorizon::Row& sky = gaps.sky[k];
    std::uint32_t open = 0;
    float widest = 0.0F;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      const bool is_open = sky[l] > 0.0F && ((wanted >> l) & 1U) != 0;
      open |= is_open ? 1U << l : 0U;
      widest = std::max(widest, is_open ? sky[l] : 0.0F);
    }
    if (open == 0) continue;
    const std::size_t count = rays_in(widest * static_cast<float>(ring.size()), rays_per_azimuth);
    const float part = 1.0F / static_cast<float>(count);
    // The gap, by the sky above its ends
    PacketHorizon::Row from, to;
    find_shares_above(gaps.from.row(k).data(), from.data());
    find_shares_above(gaps.to.row(k).data(), to.data());
    // Each ray stands for a part of it
    const auto slopes_at = [&](float place) {
      Lanes slopes;
      find_slopes(from.data(), to.data(), place, slopes.data());
      return slopes;
    };
    Lanes above_part = sky_of_azimuth(ring, k, gaps.from.row(k), weight, receivers);
    for (std::size_t n = 0; n < count; ++n) {
      const bool is_last = n + 1 == count;
      const Lanes end = is_last ? static_cast<Lanes>(gaps.to.row(k)) : slopes_at(static_cast<float>(n + 1) * part);
      const Lanes above_end = sky_of_azimuth(ring, k, end, weight, receivers);
      Occluder::Directions directions;
      directions.x.fill(ring.cosine()[k]);
      directions.y.fill(ring.sine()[k]);
      directions.z = slopes_at((static_cast<float>(n) + offset_of(k)) * part);
      const std::uint32_t asked = open & ~filled(gaps, k, directions.z);
      const std::uint32_t free = asked & ~scene.occluder.blocked(origins, directions, least_distance_m, asked);
      for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
        seen[l] += ((free >> l) & 1U) != 0 ? above_part[l] - above_end[l] : 0.0F;
      above_part = above_end;
    }
  }
  return seen;
}

}  // namespace farlod
