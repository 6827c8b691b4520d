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

// --- The sky of one azimuth
// --------------------------------------------------------------------------------------------------------

/// A(t), with t clamped to the slopes in front of the receiver, at the azimuth (cosine, sine).
FARLOD_LANES Floats sky_of_azimuth(const Floats& slope, const Normals& n, float cosine, float sine, bool is_solid) {
  const Floats outward = n.x * cosine + n.y * sine;
  const SlopeInterval in_front = slopes_in_front(outward, n.z);
  const Floats t = min(max(slope, in_front.lowest), in_front.highest);
  return is_solid ? solid_angle_above(t) : cosine_above(t, outward, n.z);
}

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

// --- Rays in gaps
// ------------------------------------------------------------------------------------------------------------------

/// sin θ = t / √(1 + t²), and its inverse.
FARLOD_LANES Floats sine_of(const Floats& slope) { return slope / sqrt(1.0F + slope * slope); }
FARLOD_LANES Floats slope_of(const Floats& sine) { return sine / sqrt(max(1.0F - sine * sine, broadcast(1e-12F))); }

void find_gap_ends(const float* from, const float* to, const ReceiverPacket& receivers, const GapAzimuth& azimuth,
                   GapEnds& ends) {
  const Normals n = normals_of(receivers);
  // Clamp both ends to the slopes in front of each receiver
  const SlopeInterval in_front = slopes_in_front(n.x * azimuth.cosine + n.y * azimuth.sine, n.z);
  const Floats begin = min(max(load(from), in_front.lowest), in_front.highest),
               end = min(max(load(to), in_front.lowest), in_front.highest);
  store(sine_of(begin), ends.sine_from.data());
  store(sine_of(end), ends.sine_to.data());
  store(sky_of_azimuth(begin, n, azimuth.cosine, azimuth.sine, azimuth.is_solid), ends.sky_from.data());
  store(sky_of_azimuth(end, n, azimuth.cosine, azimuth.sine, azimuth.is_solid), ends.sky_to.data());
}

/// Solves A(t) = A(from) + share (A(to) − A(from)). By solid angle A is linear in s = sin θ. By the cosine, three steps of
/// Newton's method from that solution: s ← s + (A(s) − target) / D, with the decline D = −dA/ds = 2 (o cos θ + w sin θ).
void find_gap_slopes(const GapEnds& ends, const ReceiverPacket& receivers, const GapAzimuth& azimuth, float share,
                     float* slopes) {
  constexpr int steps = 3;
  const Floats from = load(ends.sine_from.data()), to = load(ends.sine_to.data()), sky_from = load(ends.sky_from.data());
  const Floats target = sky_from + share * (load(ends.sky_to.data()) - sky_from);
  Floats sine = from + share * (to - from);
  if (!azimuth.is_solid) {
    const Normals n = normals_of(receivers);
    const Floats outward = n.x * azimuth.cosine + n.y * azimuth.sine;
    for (int step = 0; step < steps; ++step) {
      const Floats above = cosine_above(slope_of(sine), outward, n.z);
      const Floats decline = 2.0F * (outward * sqrt(max(1.0F - sine * sine, broadcast(0.0F))) + n.z * sine);
      // The decline vanishes on the receiver's own plane: bound the step, and stay within the gap
      sine = min(max(sine + (above - target) / max(decline, broadcast(0.01F)), from), to);
    }
  }
  store(slope_of(sine), slopes);
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
                                 .raise_to_row = raise_to_row,
                                 .raise_between_rows = raise_between_rows,
                                 .find_gap_ends = find_gap_ends,
                                 .find_gap_slopes = find_gap_slopes};
}  // namespace FARLOD_TARGET

}  // namespace farlod
