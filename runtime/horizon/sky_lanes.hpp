// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "horizon/lanes.hpp"
#include "horizon/receiver_packet.hpp"

/// How much of an azimuth's sky lies above a slope, for sixteen receivers at once. docs/concepts.md, "Above a horizon".
namespace farlod {

/// Twice ∫ (outward · cos θ + upward · sin θ) cos θ dθ from the slope t ≥ 0 to the zenith.
FARLOD_LANES Floats cosine_above(const Floats& t, const Floats& outward, const Floats& upward) {
  constexpr float half_pi = 1.57079632679F;
  const Floats arc = atan_of_fraction(t < 1.0F ? t : 1.0F / max(t, broadcast(1.0F)));
  const Floats zenith_distance = t < 1.0F ? half_pi - arc : arc, cos_square = 1.0F / (1.0F + t * t);
  return outward * (zenith_distance - t * cos_square) + upward * cos_square;
}

/// 1 − sin θ of the slope t.
FARLOD_LANES Floats solid_angle_above(const Floats& t) { return 1.0F - t / sqrt(1.0F + t * t); }

/// Stands for an infinite slope: less than 1e-12 of the sky lies above it, and no power of its inverse gets so small that the
/// processor takes its slow way.
inline constexpr float straight_up = 1e6F;

/// Of a receiver that looks along `outward` and `upward`, the slopes between which the directions lie that it looks into.
struct LookedAt {
  Floats lowest, highest;
};
FARLOD_LANES LookedAt looked_at(const Floats& outward, const Floats& upward) {
  const Floats safe = upward == 0.0F ? broadcast(1e-30F) : upward;
  const Floats border = min(abs(outward / safe), broadcast(straight_up));
  const Floats behind = upward > 0.0F ? border : broadcast(straight_up);
  return {outward > 0.0F ? broadcast(0.0F) : behind, min(outward, -upward) > 0.0F ? border : broadcast(straight_up)};
}

struct Normals {
  Floats x, y, z;
};
FARLOD_LANES Normals normals_of(const ReceiverPacket& r) {
  return {load(r.normal_x.data()), load(r.normal_y.data()), load(r.normal_z.data())};
}

/// What one azimuth adds to the sky view factor above a slope, and how it follows from the receivers' normals.
FARLOD_LANES Floats sky_of_azimuth(const Floats& slope, const Normals& n, float cosine, float sine, bool is_solid) {
  const Floats outward = n.x * cosine + n.y * sine;
  const LookedAt between = looked_at(outward, n.z);
  const Floats t = min(max(slope, between.lowest), between.highest);
  return is_solid ? solid_angle_above(t) : cosine_above(t, outward, n.z);
}

}  // namespace farlod
