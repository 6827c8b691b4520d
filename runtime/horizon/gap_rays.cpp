// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_rays.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

namespace farlod {
namespace {

using Lanes = PacketHorizon::Lanes;

/// Rays of neighboring azimuths pass at other heights: fractions of the multiples of the golden ratio spread evenly.
float offset_of(std::size_t azimuth) {
  constexpr double golden = 0.61803398874989485;
  const double multiple = golden * static_cast<double>(azimuth);
  return static_cast<float>(multiple - std::floor(multiple));
}

/// Of an azimuth's gap its ends, as sines of the elevation, and the sky above them.
struct GapEnds {
  alignas(64) Lanes sine_from, sine_to, sky_from, sky_to;
};

FARLOD_LANES Floats sine_of(const Floats& slope) { return slope / sqrt(1.0F + slope * slope); }
FARLOD_LANES Floats slope_of(const Floats& sine) { return sine / sqrt(max(1.0F - sine * sine, broadcast(1e-12F))); }

/// The directions of an azimuth.
struct Azimuth {
  float cosine, sine;
  bool is_solid;  ///< its sky is weighed by solid angle
};

FARLOD_FOR_EACH_PROCESSOR
void find_ends(const float* from, const float* to, const ReceiverPacket& receivers, const Azimuth& azimuth, GapEnds& ends) {
  const Normals n = normals_of(receivers);
  const LookedAt between = looked_at(n.x * azimuth.cosine + n.y * azimuth.sine, n.z);
  const Floats begin = min(max(load(from), between.lowest), between.highest),
               end = min(max(load(to), between.lowest), between.highest);
  store(sine_of(begin), ends.sine_from.data());
  store(sine_of(end), ends.sine_to.data());
  store(sky_of_azimuth(begin, n, azimuth.cosine, azimuth.sine, azimuth.is_solid), ends.sky_from.data());
  store(sky_of_azimuth(end, n, azimuth.cosine, azimuth.sine, azimuth.is_solid), ends.sky_to.data());
}

/// The slopes below which such a share of a gap's sky lies: Newton's method from the share of the sines.
FARLOD_FOR_EACH_PROCESSOR
void find_slopes(const GapEnds& ends, const ReceiverPacket& receivers, const Azimuth& azimuth, float share, float* slopes) {
  constexpr int steps = 3;
  const Floats from = load(ends.sine_from.data()), to = load(ends.sine_to.data()), sky_from = load(ends.sky_from.data());
  const Floats sky = sky_from + share * (load(ends.sky_to.data()) - sky_from);
  Floats sine = from + share * (to - from);
  if (!azimuth.is_solid) {
    const Normals n = normals_of(receivers);
    const Floats outward = n.x * azimuth.cosine + n.y * azimuth.sine;
    for (int step = 0; step < steps; ++step) {
      const Floats above = cosine_above(slope_of(sine), outward, n.z);
      const Floats decline = 2.0F * (outward * sqrt(max(1.0F - sine * sine, broadcast(0.0F))) + n.z * sine);
      sine = min(max(sine + (above - sky) / max(decline, broadcast(0.01F)), from), to);
    }
  }
  store(slope_of(sine), slopes);
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
    // Each ray stands for as much of its receiver's sky as the others
    const Azimuth azimuth{ring.cosine()[k], ring.sine()[k], weight == SkyWeight::solid_angle};
    GapEnds ends;
    find_ends(gaps.from.row(k).data(), gaps.to.row(k).data(), receivers, azimuth, ends);
    Lanes free_rays{};
    for (std::size_t n = 0; n < count; ++n) {
      Occluder::Directions directions;
      directions.x.fill(azimuth.cosine);
      directions.y.fill(azimuth.sine);
      find_slopes(ends, receivers, azimuth, (static_cast<float>(n) + offset_of(k)) / static_cast<float>(count),
                  directions.z.data());
      const std::uint32_t asked = open & ~filled(gaps, k, directions.z);
      const std::uint32_t free = asked & ~scene.occluder.blocked(origins, directions, least_distance_m, asked);
      for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) free_rays[l] += ((free >> l) & 1U) != 0 ? 1.0F : 0.0F;
    }
    const float ray_share = 1.0F / static_cast<float>(count * ring.size());
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      seen[l] += free_rays[l] * (ends.sky_from[l] - ends.sky_to[l]) * ray_share;
  }
  return seen;
}

}  // namespace farlod
