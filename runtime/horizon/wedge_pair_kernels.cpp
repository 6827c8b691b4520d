// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"
#include "horizon/wedge_kernels.hpp"
#include "horizon/wedge_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end. Formulas and symbols are those of docs/concepts.md, "The sky of a wedge".

namespace farlod {
namespace {

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

/// Returns 1 where something is known, else 0.
template <WedgeWeight weight>
FARLOD_LANES Floats bound_pairs_by(const WedgePairs& e, const WedgeShape& w, PairsAnswer& answer) {
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
    const Floats below = min(top, broadcast(straight_up)), high = load(answer.high);
    store(min(high, w.angle / (1.0F + below * below)), answer.low);
    answer.unknown = bits_of(known < 0.5F);
  } else {
    const Floats outward = most_outward(n.x, n.x * w.cosine + n.y * w.sine, w);
    store(sky, answer.high);
    store(min(sky, sky - most_sky_between<weight>(lid, top, outward, n.z, w.angle)), answer.low);
    const Floats is_doubtful = max(gap - 1e-6F * w.tangent, least - lid);
    answer.unknown = bits_of(known < 0.5F) | bits_of(is_doubtful > 0.0F);
  }
  return known;
}

void bound_pairs(const WedgePairs& pairs, const WedgeShape& w, WedgeWeight weight, PairsAnswer& answer) {
  switch (weight) {
    case WedgeWeight::cosine_up:
      (void)bound_pairs_by<WedgeWeight::cosine_up>(pairs, w, answer);
      return;
    case WedgeWeight::cosine:
      (void)bound_pairs_by<WedgeWeight::cosine>(pairs, w, answer);
      return;
    case WedgeWeight::solid_angle:
      (void)bound_pairs_by<WedgeWeight::solid_angle>(pairs, w, answer);
      return;
  }
}

/// All that is seen between the pair and the borders, where these are higher.
template <WedgeWeight weight>
FARLOD_LANES void bound_gaps_by(const WedgePairs& e, const float* borders, const WedgeShape& w, GapsOfPairs& gaps) {
  PairsAnswer answer;
  const Floats known = bound_pairs_by<weight>(e, w, answer);
  const Floats c = load(e.cosine), s = load(e.sine), zero = broadcast(0.0F);
  const Floats along = e.normal_x * c + e.normal_y * s, left = e.normal_y * c - e.normal_x * s;
  const Floats lid = load(answer.lid), border = load(borders);
  const Floats outward = most_outward(along, along * w.cosine + left * w.sine, w);
  Floats sky = most_sky_between<weight>(lid, border, outward, broadcast(e.normal_z), w.angle);
  if constexpr (weight == WedgeWeight::cosine_up) {
    // Nor is it more than what the pair leaves below all that hides something
    const Floats top = min(max(border, load(e.top)), broadcast(straight_up));
    const Floats below_top = load(answer.high) - w.angle / (1.0F + top * top);
    sky = choose(known < 0.5F, sky, min(sky, max(below_top, zero)));
  }
  store(choose(border > lid, sky, zero), gaps.most);
  store(lid, gaps.lid);
}

void bound_gaps(const WedgePairs& pairs, const float* borders, const WedgeShape& w, WedgeWeight weight, GapsOfPairs& gaps) {
  switch (weight) {
    case WedgeWeight::cosine_up:
      return bound_gaps_by<WedgeWeight::cosine_up>(pairs, borders, w, gaps);
    case WedgeWeight::cosine:
      return bound_gaps_by<WedgeWeight::cosine>(pairs, borders, w, gaps);
    case WedgeWeight::solid_angle:
      return bound_gaps_by<WedgeWeight::solid_angle>(pairs, borders, w, gaps);
  }
}

// --- Further edges
// ----------------------------------------------------------------------------------------------------------------

/// Edges as a receiver sees them in a wedge; how far their ends are to the left of the last azimuth; and where their lines tell
/// something: not behind the receiver, close to it, or in line with it.
struct FurtherEdges {
  EdgeInWedge e;
  Floats beyond_p, beyond_q, clear;
  PictureLine line;
};
FARLOD_LANES FurtherEdges further_edges(const WedgeEdges& w, const WedgeEye& eye) {
  const Floats ax = load(w.ax) - eye.x, ay = load(w.ay) - eye.y, bx = load(w.bx) - eye.x, by = load(w.by) - eye.y;
  const EdgeInWedge e{ax * eye.cosine + ay * eye.sine, ay * eye.cosine - ax * eye.sine, load(w.az) - eye.z,
                      bx * eye.cosine + by * eye.sine, by * eye.cosine - bx * eye.sine, load(w.bz) - eye.z};
  // Coordinates are rounded by 8 µm: slopes by a share of 6e-5
  constexpr float near_m = 0.25F;
  const Floats cross = abs(e.xp * e.sq - e.xq * e.sp);
  return {e, e.sp - eye.tangent * e.xp, e.sq - eye.tangent * e.xq,
          min(min(e.xp, e.xq) - near_m, cross - 1e-4F * (abs(e.xp) + abs(e.xq))), line_of(e.xp, e.sp, e.zp, e.xq, e.sq, e.zq)};
}

constexpr float beside_m = 1e-3F;

/// Not those that miss the wedge, nor those whose line lies below all three heights.
std::uint32_t find_above(const WedgeEdges& edges, const WedgeEye& eye) {
  const FurtherEdges f = further_edges(edges, eye);
  const Floats misses = max(min(-f.e.sp, -f.e.sq), min(f.beyond_p, f.beyond_q)) - beside_m;
  const Floats rises = max(f.line.level - eye.first, max(f.line.level + f.line.rise * eye.turn - eye.middle,
                                                         f.line.level + f.line.rise * eye.tangent - eye.last));
  constexpr float below = 1e-5F;
  // NaN is kept
  const Floats hidden = min(f.clear, -rises + below * (1.0F + eye.middle));
  const Mask out = max(misses, hidden) > 0.0F;
  return bits_of(choose(out, broadcast(0.0F), broadcast(1.0F)) > 0.0F);
}

/// The highest of the lowest heights of those that cross the wedge from border to border.
float find_lid(const WedgeEdges& edges, const WedgeEye& eye) {
  const FurtherEdges f = further_edges(edges, eye);
  const Floats crosses = min(max(-f.e.sp, -f.e.sq), max(f.beyond_p, f.beyond_q)) - beside_m;
  const Floats lowest = min(f.line.level, f.line.level + f.line.rise * eye.tangent);
  return max_lane(choose(min(crosses, f.clear) > 0.0F, lowest, broadcast(0.0F)));
}

}  // namespace

namespace FARLOD_TARGET {
extern const WedgePairKernels wedge_pair_kernels;
constexpr WedgePairKernels wedge_pair_kernels{bound_pairs, bound_gaps, find_above, find_lid};
}  // namespace FARLOD_TARGET

}  // namespace farlod
