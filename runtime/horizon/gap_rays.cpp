// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_rays.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

using Lanes = PacketHorizon::Lanes;

/// Offsets of the rays of neighboring azimuths within their parts of a gap: fractional parts of the multiples of the golden
/// ratio, which spread evenly.
float offset_of(std::size_t azimuth) {
  constexpr double golden = 0.61803398874989485;
  const double multiple = golden * static_cast<double>(azimuth);
  return static_cast<float>(multiple - std::floor(multiple));
}

/// A bit for each receiver whose slope lies between the two `filled` horizons.
std::uint32_t in_filled(const Gaps& gaps, std::size_t azimuth, const Lanes& slopes) {
  const PacketHorizon::Row &from = gaps.filled_from.row(azimuth), &to = gaps.filled_to.row(azimuth);
  std::uint32_t bits = 0;
  for (std::size_t l = 0; l < slopes.size(); ++l) bits |= slopes[l] >= from[l] && slopes[l] < to[l] ? 1U << l : 0U;
  return bits;
}

/// The receivers with a gap at one azimuth, and the largest of the gaps.
struct OpenLanes {
  std::uint32_t bits = 0;
  float max_sky = 0.0F;
};
OpenLanes open_lanes(const PacketHorizon::Row& sky, std::uint32_t wanted) {
  OpenLanes open;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    if (sky[l] <= 0.0F || !has_bit(wanted, l)) continue;
    open.bits |= 1U << l;
    open.max_sky = std::max(open.max_sky, sky[l]);
  }
  return open;
}

std::size_t ray_count(float share_of_azimuth, std::size_t rays_per_azimuth) {
  const float wanted = std::ceil(share_of_azimuth * static_cast<float>(rays_per_azimuth));
  return static_cast<std::size_t>(std::max(1.0F, wanted));
}

}  // namespace

float remove_smallest_gaps(std::span<PacketHorizon::Row> sky, std::size_t lane, float max_sky) {
  // The size of the largest gap that can be removed
  std::vector<float> sizes;
  for (const PacketHorizon::Row& row : sky)
    if (row[lane] > 0.0F) sizes.push_back(row[lane]);
  std::sort(sizes.begin(), sizes.end());
  float total = 0.0F, largest = 0.0F;
  for (const float size : sizes) {
    if (total + size > max_sky) break;
    total += size;
    largest = size;
  }
  // Remove the gaps up to that size. Of several of that size, the last may be too many
  float removed = 0.0F;
  for (PacketHorizon::Row& row : sky)
    if (row[lane] <= largest && removed + row[lane] <= max_sky) removed += std::exchange(row[lane], 0.0F);
  return removed;
}

SeenInGaps trace_gaps(const Gaps& gaps, const AzimuthSampling& azimuths, SkyWeight weight, const ReceiverPacket& receivers,
                      std::uint32_t wanted, std::size_t rays_per_azimuth, const PlacedScene& scene, const std::stop_token& stop,
                      std::span<PacketHorizon::Row> of_azimuths) {
  const SkyKernels& kernels = sky_kernels();
  const RayOrigins origins = origins_of(receivers, scene.scene_from_cell_m);
  SeenInGaps seen;
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    const OpenLanes open = open_lanes(gaps.sky[k], wanted);
    if (open.bits == 0) continue;
    // Divide each receiver's gap into parts of equal sky, with a ray in each: all rays of a receiver count alike
    const std::size_t count = ray_count(open.max_sky * static_cast<float>(azimuths.size()), rays_per_azimuth);
    const GapAzimuth azimuth{azimuths.cosine()[k], azimuths.sine()[k], weight == SkyWeight::solid_angle};
    GapEnds ends;
    kernels.find_gap_ends(gaps.from.row(k).data(), gaps.to.row(k).data(), receivers, azimuth, ends);
    Lanes free_rays{};
    for (std::size_t n = 0; n < count; ++n) {
      if (n % directions_between_looks == 0) throw_if_cancelled(stop);
      Occluder::Directions directions;
      directions.x.fill(azimuth.cosine);
      directions.y.fill(azimuth.sine);
      kernels.find_gap_slopes(ends, receivers, azimuth, (static_cast<float>(n) + offset_of(k)) / static_cast<float>(count),
                              directions.z.data());
      const std::uint32_t asked = open.bits & ~in_filled(gaps, k, directions.z);
      seen.rays += static_cast<std::uint64_t>(std::popcount(asked));
      const std::uint32_t free = asked & ~scene.occluder.blocked(origins, directions, least_distance_m, asked);
      for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) free_rays[l] += has_bit(free, l) ? 1.0F : 0.0F;
    }
    // (sky of the gap) · (free rays / rays), as a share of the turn
    const float ray_share = 1.0F / static_cast<float>(count * azimuths.size());
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      const float sky = free_rays[l] * (ends.sky_from[l] - ends.sky_to[l]) * ray_share;
      seen.sky[l] += sky;
      if (!of_azimuths.empty()) of_azimuths[k][l] += sky;
    }
  }
  return seen;
}

}  // namespace farlod
