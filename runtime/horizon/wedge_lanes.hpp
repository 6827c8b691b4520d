// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"
#include "horizon/wedge_kernels.hpp"

/// What kernels know of the sky of a wedge. Formulas and symbols are those of docs/concepts.md, "The sky of a wedge": t and u are
/// the slopes of horizons at both azimuths, and (1, τ, y) is a place of the picture plane.
namespace farlod {

/// θ / sin θ of cos θ = c ≥ 0. For short arcs by its series in x = 1 − c, within 2e-8; else arccos c = √(1 − c) P(c) (Abramowitz
/// & Stegun, 4.4.46, within 2e-8) and sin θ = √(1 − c) √(1 + c).
FARLOD_LANES Floats angle_by_sine(const Floats& cosine) {
  constexpr float short_arc = 0.06F;
  const Floats c = min(max(cosine, broadcast(0.0F)), broadcast(1.0F)), x = 1.0F - c;
  const Floats series = 1.0F + x * (0.333333333F + x * (0.133333333F + x * (0.0571428571F + x * 0.0253968254F)));
  if (!(max_lane(x) > short_arc)) return series;
  Floats p = broadcast(-0.0012624911F);
  p = p * c + 0.0066700901F;
  p = p * c - 0.0170881256F;
  p = p * c + 0.0308918810F;
  p = p * c - 0.0501743046F;
  p = p * c + 0.0889789874F;
  p = p * c - 0.2145988016F;
  p = p * c + 1.5707963050F;
  return choose(x > short_arc, p / sqrt(1.0F + c), series);
}

/// sin of an elevation with this slope.
FARLOD_LANES Floats sine_of(const Floats& slope) {
  const Floats s = min(slope, broadcast(straight_up));
  return s / sqrt(1.0F + s * s);
}

/// Girard: the solid angle of the triangle between the zenith, p and q, where det = (p × q)_z. |p| and |q| are their lengths.
FARLOD_LANES Floats solid_angle(const Floats& det, const Floats& dot, const Floats& pz, const Floats& qz, const Floats& p,
                                const Floats& q) {
  return 2.0F * atan_of_fraction(min(max(det, broadcast(0.0F)) / (p * q + pz * q + dot + qz * p), broadcast(1.0F)));
}

/// Two azimuths, and all their receivers' slopes there.
struct Arc {
  float from_x, from_y, to_x, to_y;
  Floats t, u;
};
/// Above the arc from (cos φ, sin φ, t) on: Lambert's term of the arc, (p × q) · n θ / sin θ / (|p| |q|), or the solid angle.
template <WedgeWeight weight>
FARLOD_LANES Floats sky_above(const Arc& a, const Normals& n, const WedgeShape& w) {
  const Floats p = 1.0F + a.t * a.t, q = 1.0F + a.u * a.u, dot = w.cosine + a.t * a.u;
  if constexpr (weight == WedgeWeight::solid_angle) return solid_angle(broadcast(w.sine), dot, a.t, a.u, sqrt(p), sqrt(q));
  const Floats root = 1.0F / sqrt(p * q);
  if constexpr (weight == WedgeWeight::cosine_up) return w.sine * root * angle_by_sine(dot * root);
  const Floats across_x = a.from_y * a.u - a.t * a.to_y, across_y = a.t * a.to_x - a.from_x * a.u;
  return (n.x * across_x + n.y * across_y + n.z * w.sine) * root * angle_by_sine(dot * root);
}

/// The same for the arc from (1, τ, y) to (1, υ, z), with the normal in the frame of the picture plane.
template <WedgeWeight weight>
FARLOD_LANES Floats sky_above(const Floats& t, const Floats& y, const Floats& u, const Floats& z, const Normals& n) {
  const Floats p = 1.0F + t * t + y * y, q = 1.0F + u * u + z * z, dot = 1.0F + t * u + y * z, det = u - t;
  if constexpr (weight == WedgeWeight::solid_angle) return solid_angle(det, dot, y, z, sqrt(p), sqrt(q));
  const Floats scale = 1.0F / sqrt(p * q), by_sine = scale * angle_by_sine(dot * scale);
  if constexpr (weight == WedgeWeight::cosine_up) return max(det, broadcast(0.0F)) * by_sine;
  return (n.x * (t * z - y * u) + n.y * (y - z) + n.z * det) * by_sine;
}

/// Lambert's term of an upright border from (1, τ, y) to the zenith.
FARLOD_LANES Floats above_border(const Floats& t, const Floats& y, const Normals& n) {
  const Floats run = sqrt(1.0F + t * t), slope = max(y, broadcast(0.0F)) / run;
  const Floats arc = atan_of_fraction(choose(slope < 1.0F, slope, 1.0F / max(slope, broadcast(1.0F))));
  return choose(slope < 1.0F, 1.57079632679F - arc, arc) * (t * n.x - n.y) / run;
}

/// The most that a normal points outwards at some azimuth of a wedge, of its parts at both ends.
FARLOD_LANES Floats most_outward(const Floats& from, const Floats& to, const WedgeShape& w) {
  const Floats most = max(from, to);
  // A sinusoid is concave where it is positive
  return choose(most > 0.0F, w.widened * most, most);
}

/// At most so much sky lies between two slopes in a wedge: all of it is seen as where the normal points outwards most.
template <WedgeWeight weight>
FARLOD_LANES Floats most_sky_between(const Floats& low, const Floats& high, const Floats& outward, const Floats& upward,
                                     float angle) {
  const Floats none = broadcast(0.0F);
  if constexpr (weight == WedgeWeight::solid_angle) return angle * max(sine_of(high) - sine_of(low), none);
  const Floats below = min(high, broadcast(straight_up));
  if constexpr (weight == WedgeWeight::cosine_up) return max(angle / (1.0F + low * low) - angle / (1.0F + below * below), none);
  const SlopeInterval in_front = slopes_in_front(outward, upward);
  // Not by a lambda, which would be emitted on its own for each target
  const Floats from = min(max(low, in_front.lowest), in_front.highest), to = min(max(below, in_front.lowest), in_front.highest);
  return angle * max(cosine_above(from, outward, upward) - cosine_above(to, outward, upward), none);
}

}  // namespace farlod
