// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"
#include "horizon/wedge_kernels.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end. Formulas and symbols are those of docs/concepts.md, "The sky of a wedge": t and u are the
// slopes of horizons at both azimuths, and (1, τ, y) is a place of the picture plane.

namespace farlod {
namespace {

// --- The sky above an arc
// ---------------------------------------------------------------------------------------------------------

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
  const auto above = [&](const Floats& slope) {
    return cosine_above(min(max(slope, in_front.lowest), in_front.highest), outward, upward);
  };
  return angle * max(above(low) - above(below), none);
}

/// Horizons raised to the receivers' own planes, below which they see nothing: the plane is one more edge. Behind a wall all is
/// hidden.
void raise_to_planes(const float* slopes, const std::int32_t* numbers, const ReceiverPacket& r, const AzimuthView& a,
                     float* raised, std::int32_t* raised_numbers) {
  const Normals n = normals_of(r);
  constexpr float level = 1e-6F;
  const Floats tilted_up = choose(n.z > level, broadcast(1.0F), broadcast(0.0F));
  const Floats inverse = 1.0F / choose(n.z > level, n.z, broadcast(1.0F));
  for (std::size_t k = 0; k < a.size; ++k) {
    const std::size_t at = k * lane_count;
    const Floats outward = n.x * a.cosine[k] + n.y * a.sine[k], horizon = min(load(slopes + at), broadcast(straight_up));
    const Floats plane = min(-outward * inverse, broadcast(straight_up));
    const Ints number = load(numbers + at);
    const Mask is_plane = choose(tilted_up > 0.5F, plane - horizon, broadcast(-1.0F)) > 0.0F;
    const Mask is_behind = choose(abs(n.z) > level, broadcast(-1.0F), -outward) >= 0.0F;
    const Floats above = choose(is_plane, plane, horizon);
    store(choose(is_behind, broadcast(straight_up), above), raised + at);
    store(choose(is_behind, broadcast(std::int32_t{number_behind}),
                 choose(is_plane, broadcast(std::int32_t{number_of_plane}), number)),
          raised_numbers + at);
  }
}

// --- Simple wedges
// ----------------------------------------------------------------------------------------------------------------

/// For the receivers for whom a wedge is simple 1, else 0.
FARLOD_LANES Floats simple_of(const NumberedHorizon& h, std::size_t at, std::size_t next, const Floats& rising,
                              const Floats& lower) {
  const Mask is_same = load(h.numbers + at) == load(h.numbers + next);
  return choose(is_same, choose(rising > lower, broadcast(0.0F), broadcast(1.0F)), broadcast(0.0F));
}

/// A simple wedge, and what hides its sky besides: for receivers that look up, bounds follow; for others, it is not simple.
struct SimpleWedge {
  Floats simple, arc, lower, higher, least, most;
};
template <WedgeWeight weight>
FARLOD_LANES void add_simple(const SimpleWedge& s, const WedgeShape& w, Sum& low, Sum& high) {
  const Floats sky = s.simple * s.arc;
  if (weight != WedgeWeight::cosine_up || !(max_lane(max(s.least, s.most) - s.lower) > 0.0F)) {
    low.add(sky);
    high.add(sky);
    return;
  }
  const auto above = [&](const Floats& slope) { return s.simple * (w.angle / (1.0F + slope * slope)); };
  const Floats lid = max(s.higher * w.widened, min(s.most, broadcast(straight_up)));
  low.add(choose(s.most > s.lower, above(lid), sky));
  high.add(choose(s.least > s.lower, min(sky, above(s.least)), sky));
}

template <WedgeWeight weight>
FARLOD_LANES void sum_simple_by(const NumberedHorizon& h, const HidingRows& hiding, const ReceiverPacket& r, const AzimuthView& a,
                                const WedgeShape& w, std::uint16_t* others, float* tops, SimpleSums& sums) {
  Sum low(sums.low_rows), high(sums.high_rows);
  const Normals n = normals_of(r);
  // Several at once: roots and divisions of one would wait for each other
  constexpr std::size_t at_once = 4;
  const auto after = [&](std::size_t k) { return k + 1 < a.size ? k + 1 : 0; };
  const auto slopes = [&](std::size_t k) { return min(load(h.slopes + k * lane_count), broadcast(straight_up)); };
  for (std::size_t first = 0; first < a.size; first += at_once) {
    Floats arcs[at_once];
    for (std::size_t m = 0; m < at_once; ++m) {
      const std::size_t k = std::min<std::size_t>(first + m, a.size - 1), next = after(k);
      arcs[m] = sky_above<weight>({a.cosine[k], a.sine[k], a.cosine[next], a.sine[next], slopes(k), slopes(next)}, n, w);
    }
    for (std::size_t k = first; k < std::min<std::size_t>(first + at_once, a.size); ++k) {
      const std::size_t at = k * lane_count, next = after(k) * lane_count;
      const Floats t = load(h.slopes + at), u = load(h.slopes + next), top = load(tops + at);
      SimpleWedge s{{}, arcs[k - first], min(t, u), max(t, u), load(hiding.least + at), load(hiding.most + at)};
      const Floats rising = weight == WedgeWeight::cosine_up ? top : max(top, max(s.least, s.most));
      s.simple = simple_of(h, at, next, rising, s.lower);
      others[k] = static_cast<std::uint16_t>(bits_of(s.simple < 0.5F));
      store(max(top, s.higher), tops + at);
      add_simple<weight>(s, w, low, high);
    }
  }
  store(low.total(), sums.low);
  store(high.total(), sums.high);
}

void sum_simple(const NumberedHorizon& h, const HidingRows& hiding, const ReceiverPacket& r, const AzimuthView& a,
                const WedgeShape& w, WedgeWeight weight, std::uint16_t* others, float* tops, SimpleSums& sums) {
  switch (weight) {
    case WedgeWeight::cosine_up:
      return sum_simple_by<WedgeWeight::cosine_up>(h, hiding, r, a, w, others, tops, sums);
    case WedgeWeight::cosine:
      return sum_simple_by<WedgeWeight::cosine>(h, hiding, r, a, w, others, tops, sums);
    case WedgeWeight::solid_angle:
      return sum_simple_by<WedgeWeight::solid_angle>(h, hiding, r, a, w, others, tops, sums);
  }
}

template <WedgeWeight weight>
FARLOD_LANES void find_simple_gaps_by(const NumberedHorizon& h, const AskedBorders& asked, const ReceiverPacket& r,
                                      const AzimuthView& a, const WedgeShape& w, std::uint16_t* others, float* tops,
                                      float* gaps) {
  const Normals n = normals_of(r);
  const Floats none = broadcast(0.0F);
  for (std::size_t k = 0; k < a.size; ++k) {
    if (asked.wedges[k] == 0) continue;
    const std::size_t after = k + 1 < a.size ? k + 1 : 0, at = k * lane_count, next = after * lane_count;
    const Floats t = load(h.slopes + at), u = load(h.slopes + next), lower = min(t, u), higher = max(t, u);
    const Floats simple = simple_of(h, at, next, load(tops + at), lower), border = load(asked.borders + at);
    others[k] = static_cast<std::uint16_t>(bits_of(simple < 0.5F));
    store(max(load(tops + at), higher), tops + at);
    const Floats outward = most_outward(n.x * a.cosine[k] + n.y * a.sine[k], n.x * a.cosine[after] + n.y * a.sine[after], w);
    const Floats sky = most_sky_between<weight>(lower, border, outward, n.z, w.angle);
    store(choose(border > lower, simple * sky, none), gaps + at);
  }
}

void find_simple_gaps(const NumberedHorizon& h, const AskedBorders& asked, const ReceiverPacket& r, const AzimuthView& a,
                      const WedgeShape& w, WedgeWeight weight, std::uint16_t* others, float* tops, float* gaps) {
  switch (weight) {
    case WedgeWeight::cosine_up:
      return find_simple_gaps_by<WedgeWeight::cosine_up>(h, asked, r, a, w, others, tops, gaps);
    case WedgeWeight::cosine:
      return find_simple_gaps_by<WedgeWeight::cosine>(h, asked, r, a, w, others, tops, gaps);
    case WedgeWeight::solid_angle:
      return find_simple_gaps_by<WedgeWeight::solid_angle>(h, asked, r, a, w, others, tops, gaps);
  }
}

// --- Pairs of edges
// ---------------------------------------------------------------------------------------------------------------

/// The line of an edge in the picture plane: y = (p_z v + q_z u) / (p × q), with u and v of the direction (1, τ).
struct PictureLine {
  Floats level, rise;
};
/// By the ways of its ends along the first azimuth (x), to its left (s), and up.
FARLOD_LANES PictureLine line_of(const Floats& xp, const Floats& sp, const Floats& zp, const Floats& xq, const Floats& sq,
                                 const Floats& zq) {
  const Floats cross = xp * sq - xq * sp, inverse = 1.0F / choose(cross == 0.0F, broadcast(1e-20F), cross);
  return {(zp * sq - zq * sp) * inverse, (zq * xp - zp * xq) * inverse};
}

/// An edge by the ways of its ends along the first azimuth of a wedge (x), to its left (s), and up.
struct EdgeInWedge {
  Floats xp, sp, zp, xq, sq, zq;
};

struct Joint {
  Floats before, after;  ///< τ where the first edge ends, and where the last one begins
};
/// Where the edge of the last azimuth takes over: where it begins above the other one, or they cross, or the other one ends.
/// Where it begins after that one's end, both are apart.
FARLOD_LANES Joint joint_of(const EdgeInWedge& p, const EdgeInWedge& v, const PictureLine& first, const PictureLine& last,
                            const Floats& end) {
  const Floats zero = broadcast(0.0F), tiny = broadcast(1e-6F);
  // The end that is more to the left; beyond the wedge where it is behind
  const Floats x1 = choose(p.sq > p.sp, p.xq, p.xp), s1 = max(p.sp, p.sq);
  const Floats to = min(choose(x1 > tiny, s1 / max(x1, tiny), end), end);
  // The end that is more to the right of the last azimuth
  const Mask v_is_right = v.sp - end * v.xp < v.sq - end * v.xq;
  const Floats x2 = choose(v_is_right, v.xp, v.xq), s2 = choose(v_is_right, v.sp, v.sq);
  const Floats from = max(choose(x2 > tiny, s2 / max(x2, tiny), zero), zero);
  const Floats gain = last.rise - first.rise;
  const Floats crossing = (first.level - last.level) / choose(gain == 0.0F, broadcast(1e-20F), gain);
  const Mask begins_above = last.level + last.rise * from > first.level + first.rise * from;
  const Floats joined = choose(begins_above, from, min(max(crossing, from), to));
  const Mask is_apart = from > to;
  return {choose(is_apart, to, joined), choose(is_apart, min(from, end), joined)};
}

/// A slope below which both edges hide all of the wedge: none where they are apart. Nothing is known where their lines are not
/// the horizons that were drawn, or where these dip.
FARLOD_LANES Floats lid_of(const WedgePairs& e, const WedgeShape& w, const Floats& dip, const PairsAnswer& answer,
                           Floats& known) {
  const Floats first = load(answer.first), last = load(answer.last), zero = broadcast(0.0F), one = broadcast(1.0F);
  const Floats from = load(e.from), to = load(e.to) * (1.0F / w.cosine);
  constexpr float rounding = 2e-6F;
  const Floats differs =
      max(dip - rounding * (1.0F + from), max(abs(first - from) - 1e-3F * (1.0F + from), abs(last - to) - 1e-3F * (1.0F + to)));
  // A NaN differs
  known = choose(differs <= 0.0F, one, zero);
  // A place of the picture plane is seen at its height times cos φ
  const Floats lowest = (0.9999F * w.cosine) * min(min(first, load(answer.before)), min(load(answer.after), last));
  return choose(load(answer.gap) > 1e-6F * w.tangent, zero, known * lowest);
}

FARLOD_LANES EdgeInWedge edge_in_wedge(const EdgesSeen& e, const Floats& cosine, const Floats& sine) {
  const Floats ax = load(e.px), ay = load(e.py), bx = load(e.qx), by = load(e.qy);
  return {ax * cosine + ay * sine, ay * cosine - ax * sine, load(e.pz),
          bx * cosine + by * sine, by * cosine - bx * sine, load(e.qz)};
}

/// How far an edge's line is below the level, or below the receiver's own plane, at a place of the picture plane.
FARLOD_LANES Floats dip_of(const Floats& height, const Floats& tau, const Normals& n) {
  constexpr float level = 1e-6F;
  const Floats upward = choose(n.z > level, n.z, broadcast(1.0F)), plane = -(n.x + n.y * tau) / upward;
  return max(choose(n.z > level, plane, broadcast(0.0F)), broadcast(0.0F)) - height;
}

/// Lays both edges into the picture plane. Returns how far they dip where one follows the other: there, neither is the horizon.
FARLOD_LANES Floats place_pairs(const WedgePairs& e, const WedgeShape& w, const Normals& n, PairsAnswer& answer) {
  const Floats c = load(e.cosine), s = load(e.sine), end = broadcast(w.tangent), zero = broadcast(0.0F);
  const EdgeInWedge p = edge_in_wedge(e.first, c, s);
  const EdgeInWedge v = edge_in_wedge(e.last, c, s);
  const PictureLine first = line_of(p.xp, p.sp, p.zp, p.xq, p.sq, p.zq), last = line_of(v.xp, v.sp, v.zp, v.xq, v.sq, v.zq);
  const Joint joint = joint_of(p, v, first, last, end);
  store(joint.before, answer.turn);
  store(joint.after - joint.before, answer.gap);
  store(max(first.level, zero), answer.first);
  const Floats before = first.level + first.rise * joint.before, after = last.level + last.rise * joint.after;
  store(max(before, zero), answer.before);
  store(max(after, zero), answer.after);
  store(max(last.level + end * last.rise, zero), answer.last);
  return max(dip_of(before, joint.before, n), dip_of(after, joint.after, n));
}

template <WedgeWeight weight>
FARLOD_LANES void bound_pairs_by(const WedgePairs& e, const WedgeShape& w, PairsAnswer& answer) {
  const Floats c = load(e.cosine), s = load(e.sine), zero = broadcast(0.0F);
  const Normals n{e.normal_x * c + e.normal_y * s, e.normal_y * c - e.normal_x * s, broadcast(e.normal_z)};
  const Floats dip = place_pairs(e, w, n, answer);
  const Floats turn = load(answer.turn), gap = load(answer.gap), before = load(answer.before), after = load(answer.after);
  const Floats top = load(e.top), least = load(e.least), end = broadcast(w.tangent);
  Floats sky = sky_above<weight>(zero, load(answer.first), turn, before, n) +
               sky_above<weight>(turn + gap, after, end, load(answer.last), n);
  if constexpr (weight == WedgeWeight::cosine) sky += above_border(turn, before, n) - above_border(turn, after, n);
  Floats known = zero;
  const Floats lid = lid_of(e, w, dip, answer, known);
  store(lid, answer.lid);
  if constexpr (weight == WedgeWeight::cosine_up) {
    // Between both, all may be sky
    store(min(sky + gap, w.angle / (1.0F + least * least)), answer.high);
    const Floats below = min(top, broadcast(straight_up));
    store(w.angle / (1.0F + below * below), answer.low);
    answer.unknown = bits_of(known < 0.5F);
  } else {
    const Floats outward = most_outward(n.x, n.x * w.cosine + n.y * w.sine, w);
    store(sky, answer.high);
    store(sky - most_sky_between<weight>(lid, top, outward, n.z, w.angle), answer.low);
    const Floats is_doubtful = max(gap - 1e-6F * w.tangent, least - lid);
    answer.unknown = bits_of(known < 0.5F) | bits_of(is_doubtful > 0.0F);
  }
}

void bound_pairs(const WedgePairs& pairs, const WedgeShape& w, WedgeWeight weight, PairsAnswer& answer) {
  switch (weight) {
    case WedgeWeight::cosine_up:
      return bound_pairs_by<WedgeWeight::cosine_up>(pairs, w, answer);
    case WedgeWeight::cosine:
      return bound_pairs_by<WedgeWeight::cosine>(pairs, w, answer);
    case WedgeWeight::solid_angle:
      return bound_pairs_by<WedgeWeight::solid_angle>(pairs, w, answer);
  }
}

// --- Further edges
// ----------------------------------------------------------------------------------------------------------------

/// Not those that miss the wedge, nor those whose line lies below all three heights.
std::uint32_t find_above(const WedgeEdges& e, const WedgeEye& eye) {
  const Floats ax = load(e.ax) - eye.x, ay = load(e.ay) - eye.y, az = load(e.az) - eye.z;
  const Floats bx = load(e.bx) - eye.x, by = load(e.by) - eye.y, bz = load(e.bz) - eye.z;
  const Floats along_a = ax * eye.cosine + ay * eye.sine, along_b = bx * eye.cosine + by * eye.sine;
  const Floats left_a = ay * eye.cosine - ax * eye.sine, left_b = by * eye.cosine - bx * eye.sine;
  const Floats beyond_a = left_a - eye.tangent * along_a, beyond_b = left_b - eye.tangent * along_b;
  constexpr float margin = 1e-3F;
  const Floats misses = max(min(-left_a, -left_b), min(beyond_a, beyond_b)) - margin;
  const PictureLine line = line_of(along_a, left_a, az, along_b, left_b, bz);
  const Floats rises = max(line.level - eye.first,
                           max(line.level + line.rise * eye.turn - eye.middle, line.level + line.rise * eye.tangent - eye.last));
  constexpr float below = 1e-5F;
  // Behind the receiver, or in line with it, lines say nothing
  const Floats cross = along_a * left_b - along_b * left_a;
  const Floats is_clear = min(min(along_a, along_b) - 1e-3F, abs(cross) - 1e-4F * (abs(along_a) + abs(along_b)));
  // NaN is kept
  const Floats hidden = min(is_clear, -rises + below * (1.0F + eye.middle));
  const Mask out = max(misses, hidden) > 0.0F;
  return bits_of(choose(out, broadcast(0.0F), broadcast(1.0F)) > 0.0F);
}

}  // namespace

namespace FARLOD_TARGET {
extern const WedgeSkyKernels wedge_sky_kernels;
constexpr WedgeSkyKernels wedge_sky_kernels{raise_to_planes, sum_simple, find_simple_gaps, bound_pairs, find_above};
}  // namespace FARLOD_TARGET

}  // namespace farlod
