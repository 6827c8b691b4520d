// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "horizon/kernels.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end. Formulas and symbols are those of docs/concepts.md, "Above a horizon": t is the slope of
// the horizon, o and w are the parts of the normal that point outwards along the azimuth, and up.

namespace farlod {
namespace {

static_assert(ReceiverPacket::lanes == lane_count);

// --- The sky above horizons: sums over the azimuths, in their order
// ----------------------------------------------------------------

/// n = (0, 0, 1): F = cos²β = 1 / (1 + t²).
void sum_cosine_up(const float* slopes, std::size_t azimuth_count, float* sums, float* rows) {
  Sum sum(rows);
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    const Floats t = load(slopes + k * lane_count);
    sum.add(1.0F / (1.0F + t * t));
  }
  store(sum.total(), sums);
}

/// w = 0, as on walls: the azimuths in front count, o > 0, up to the zenith.
void sum_cosine_level(const float* slopes, const ReceiverPacket& receivers, const AzimuthView& azimuths, float* sums,
                      float* rows) {
  const Floats x = load(receivers.normal_x.data()), y = load(receivers.normal_y.data());
  Sum sum(rows);
  for (std::size_t k = 0; k < azimuths.size; ++k) {
    // Skip the azimuths behind all sixteen
    const Floats outward = max(x * azimuths.cosine[k] + y * azimuths.sine[k], broadcast(0.0F));
    if (max_lane(outward) == 0.0F) {
      sum.skip();
      continue;
    }
    const Floats t = min(load(slopes + k * lane_count), broadcast(straight_up));
    sum.add(cosine_above(t, outward, broadcast(0.0F)));
  }
  store(sum.total(), sums);
}

/// F = A(t) − A(highest), with t clamped to the slopes in front.
void sum_cosine(const float* slopes, const ReceiverPacket& receivers, const AzimuthView& azimuths, float* sums, float* rows) {
  const Normals n = normals_of(receivers);
  Sum sum(rows);
  for (std::size_t k = 0; k < azimuths.size; ++k) {
    const Floats outward = n.x * azimuths.cosine[k] + n.y * azimuths.sine[k];
    const SlopeInterval in_front = slopes_in_front(outward, n.z);
    const Floats t = min(max(load(slopes + k * lane_count), in_front.lowest), in_front.highest);
    sum.add(cosine_above(t, outward, n.z) - cosine_above(in_front.highest, outward, n.z));
  }
  store(sum.total(), sums);
}

/// The same by solid angle.
void sum_solid_angle(const float* slopes, const ReceiverPacket& receivers, const AzimuthView& azimuths, float* sums,
                     float* rows) {
  const Normals n = normals_of(receivers);
  Sum sum(rows);
  for (std::size_t k = 0; k < azimuths.size; ++k) {
    const SlopeInterval in_front = slopes_in_front(n.x * azimuths.cosine[k] + n.y * azimuths.sine[k], n.z);
    const Floats t = min(max(load(slopes + k * lane_count), in_front.lowest), in_front.highest);
    sum.add(solid_angle_above(t) - solid_angle_above(in_front.highest));
  }
  store(sum.total(), sums);
}

/// rows[k] = max(0, A(low) − A(high)) / K.
void find_sky_between(const float* low, const float* high, const ReceiverPacket& receivers, const AzimuthView& azimuths,
                      bool is_solid, float* rows) {
  const Normals n = normals_of(receivers);
  const float share = 1.0F / static_cast<float>(azimuths.size);
  for (std::size_t k = 0; k < azimuths.size; ++k) {
    const Floats from = load(low + k * lane_count), to = load(high + k * lane_count);
    float* row = rows + k * lane_count;
    // Most azimuths have no gap for any receiver
    if (max_lane(to - from) == 0.0F) {
      store(Floats{}, row);
      continue;
    }
    const float cosine = azimuths.cosine[k], sine = azimuths.sine[k];
    const Floats sky = sky_of_azimuth(from, n, cosine, sine, is_solid) - sky_of_azimuth(to, n, cosine, sine, is_solid);
    store(max(sky, broadcast(0.0F)) * share, row);
  }
}

// --- Where the sky jumps
// ------------------------------------------------------------------------------------------------------------

std::size_t find_jumps(const float* rows, const std::int32_t* numbers, std::size_t azimuth_count, float least, SkyJump* jumps) {
  // Few azimuths have a jump for any receiver: look at several at once
  constexpr std::size_t at_once = 4;
  std::size_t count = 0;
  for (std::size_t first = 0; first < azimuth_count; first += at_once) {
    const std::size_t end = first + at_once < azimuth_count ? first + at_once : azimuth_count;
    std::uint32_t receivers[at_once], any = 0;
    for (std::size_t k = first; k < end; ++k) {
      const std::size_t next = k + 1 < azimuth_count ? k + 1 : 0;
      const Floats jump = load(rows + k * lane_count) - load(rows + next * lane_count);
      const Mask is_same = load(numbers + k * lane_count) == load(numbers + next * lane_count);
      receivers[k - first] = bits_of(choose(is_same, broadcast(-1.0F), abs(jump) - least) > 0.0F);
      any |= receivers[k - first];
    }
    if (any == 0) continue;
    for (std::size_t k = first; k < end; ++k)
      if (receivers[k - first] != 0) jumps[count++] = {static_cast<std::uint32_t>(k), receivers[k - first]};
  }
  return count;
}

// --- Horizons against horizons, row by row
// -----------------------------------------------------------------------------------------

void lower(const float* other, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    store(min(load(row), load(other + k * lane_count)), row);
  }
}

void raise(const float* other, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    store(max(load(row), load(other + k * lane_count)), row);
  }
}

void replace_infinite(const float* other, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    const Floats t = load(row);
    store(choose(t < std::numeric_limits<float>::infinity(), t, load(other + k * lane_count)), row);
  }
}

void join(const float* lower, const float* upper, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    const Floats t = load(row), begin = load(lower + k * lane_count);
    const Floats end = choose(begin > t, broadcast(0.0F), load(upper + k * lane_count));
    store(max(t, end), row);
  }
}

void find_max_difference(const float* slopes, const float* other, std::size_t azimuth_count, float* differences) {
  Floats largest = broadcast(-1.0F);
  for (std::size_t k = 0; k < azimuth_count; ++k)
    largest = max(largest, load(slopes + k * lane_count) - load(other + k * lane_count));
  store(largest, differences);
}

void count_above(const float* slopes, const float* ray_slopes, std::size_t azimuth_count, float* counts) {
  Floats count{};
  for (std::size_t k = 0; k < azimuth_count; ++k)
    count += choose(load(slopes + k * lane_count) < ray_slopes[k], broadcast(1.0F), broadcast(0.0F));
  store(count, counts);
}

void find_rays_above(const float* slopes, std::span<const RayBetweenAzimuths> rays, std::uint16_t* above) {
  for (const RayBetweenAzimuths& ray : rays) {
    const Floats horizon =
        max(load(slopes + std::size_t{ray.before} * lane_count), load(slopes + std::size_t{ray.after} * lane_count));
    *above++ = static_cast<std::uint16_t>(bits_of(horizon < ray.slope));
  }
}

// --- Horizons raised to a far map's bins
// -------------------------------------------------------------------------------------------

void raise_to_row(const float* row, const float* caps, const std::uint32_t* bin_of_azimuth, std::size_t azimuth_count,
                  float* slopes) {
  const Floats cap = load(caps);
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* lanes = slopes + k * lane_count;
    store(max(load(lanes), min(broadcast(row[bin_of_azimuth[k]]), cap)), lanes);
  }
}

void raise_between_rows(const ResidualRows& rows, const std::uint32_t* bin_of_azimuth, std::size_t azimuth_count, float* slopes,
                        std::int32_t* numbers) {
  const Floats shares = load(rows.shares.data()), caps = load(rows.caps.data());
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    // Interpolate between two levels of the map, each receiver at its own height
    const std::uint32_t bin = bin_of_azimuth[k];
    const float here = rows.here[bin], rise = rows.above[bin] - here;
    const Floats estimate = min(max(here + shares * rise, broadcast(rows.lower[bin])), broadcast(rows.upper[bin]));
    float* row = slopes + k * lane_count;
    const Floats slope = load(row), residual = min(estimate, caps);
    store(max(slope, residual), row);
    if (numbers == nullptr) continue;
    std::int32_t* edges = numbers + k * lane_count;
    store(choose(residual >= slope, broadcast(-1), load(edges)), edges);
  }
}

}  // namespace

namespace FARLOD_TARGET {
extern const SkyKernels sky_kernels;
constexpr SkyKernels sky_kernels{.sum_cosine_up = sum_cosine_up,
                                 .sum_cosine_level = sum_cosine_level,
                                 .sum_cosine = sum_cosine,
                                 .sum_solid_angle = sum_solid_angle,
                                 .find_jumps = find_jumps,
                                 .find_sky_between = find_sky_between,
                                 .lower = lower,
                                 .raise = raise,
                                 .replace_infinite = replace_infinite,
                                 .join = join,
                                 .find_max_difference = find_max_difference,
                                 .count_above = count_above,
                                 .find_rays_above = find_rays_above,
                                 .raise_to_row = raise_to_row,
                                 .raise_between_rows = raise_between_rows};
}  // namespace FARLOD_TARGET

}  // namespace farlod
