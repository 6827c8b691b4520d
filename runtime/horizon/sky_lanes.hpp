// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "horizon/lanes.hpp"
#include "horizon/receiver_packet.hpp"

/// What kernels know of the sky at one azimuth. Formulas and symbols are those of docs/concepts.md, "Above a horizon": t is the
/// slope of the horizon, o and w are the parts of the normal that point outwards along the azimuth, and up.
namespace farlod {

/// A(t) = o (π/2 − arctan t − t / (1 + t²)) + w / (1 + t²): twice the cosine integral from the slope t ≥ 0 to the zenith.
FARLOD_LANES Floats cosine_above(const Floats& t, const Floats& outward, const Floats& upward) {
  constexpr float half_pi = 1.57079632679F;
  // The zenith distance π/2 − arctan t, by the polynomial of t or of 1/t, whichever is at most 1
  const Floats arc = atan_of_fraction(choose(t < 1.0F, t, 1.0F / max(t, broadcast(1.0F))));
  const Floats zenith_distance = choose(t < 1.0F, half_pi - arc, arc), cos_square = 1.0F / (1.0F + t * t);
  return outward * (zenith_distance - t * cos_square) + upward * cos_square;
}

/// A(t) = 1 − t / √(1 + t²), by solid angle.
FARLOD_LANES Floats solid_angle_above(const Floats& t) { return 1.0F - t / sqrt(1.0F + t * t); }

/// The slope that stands for infinity: less than 1e-12 of the sky lies above it, and no power of its inverse is denormal, which
/// the processor would compute slowly.
inline constexpr float straight_up = 1e6F;

/// The slopes between which the directions of an azimuth are in front of a receiver: o cos θ + w sin θ > 0.
struct SlopeInterval {
  Floats lowest, highest;
};
FARLOD_LANES SlopeInterval slopes_in_front(const Floats& outward, const Floats& upward) {
  // The slope on the receiver's own plane, |o / w|
  const Floats nonzero = choose(upward == 0.0F, broadcast(1e-30F), upward);
  const Floats border = min(abs(outward / nonzero), broadcast(straight_up));
  // o ≤ 0: from the border on, if the receiver is tilted up. o > 0, w < 0: up to the border. The table of "Above a horizon"
  const Floats behind = choose(upward > 0.0F, border, broadcast(straight_up));
  return {choose(outward > 0.0F, broadcast(0.0F), behind), choose(min(outward, -upward) > 0.0F, border, broadcast(straight_up))};
}

struct Normals {
  Floats x, y, z;
};
FARLOD_LANES Normals normals_of(const ReceiverPacket& r) {
  return {load(r.normal_x.data()), load(r.normal_y.data()), load(r.normal_z.data())};
}

/// A(t), with t clamped to the slopes in front of the receiver, at the azimuth (cosine, sine).
FARLOD_LANES Floats sky_of_azimuth(const Floats& slope, const Normals& n, float cosine, float sine, bool is_solid) {
  const Floats outward = n.x * cosine + n.y * sine;
  const SlopeInterval in_front = slopes_in_front(outward, n.z);
  const Floats t = min(max(slope, in_front.lowest), in_front.highest);
  return is_solid ? solid_angle_above(t) : cosine_above(t, outward, n.z);
}

/// A float that is added to a sum of thousands is rounded to few of its bits, and the same way each time where the horizon is
/// even. So terms are added up in blocks of 256, and the blocks with compensation (Kahan): rounding does not grow beyond that of
/// one block, however many azimuths there are. Terms are written to `rows`, if there are rows.
struct Sum {
  FARLOD_LANES explicit Sum(float* rows) : next_row(rows) {}

  Floats sum{}, lost{}, block{};
  float* next_row;
  std::size_t terms = 0;

  FARLOD_LANES void write(const Floats& term) {
    if (next_row == nullptr) return;
    store(term, next_row);
    next_row += lane_count;
  }
  /// A term of 0, which does not count among the terms of a block.
  FARLOD_LANES void skip() { write(Floats{}); }
  FARLOD_LANES void add(const Floats& term) {
    write(term);
    block += term;
    if (++terms % 256 == 0) add_block();
  }
  FARLOD_LANES void add_block() {
    // What rounding took from the sum before goes with this block; what it takes now shows in the difference of both sums
    const Floats term = block - lost, next = sum + term;
    lost = (next - sum) - term;
    sum = next;
    block = Floats{};
  }
  FARLOD_LANES Floats total() {
    add_block();
    return sum;
  }
};

}  // namespace farlod
