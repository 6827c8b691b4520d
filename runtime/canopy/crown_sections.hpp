// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "canopy/crown_batches.hpp"
#include "canopy/crown_kernels.hpp"
#include "canopy/dimmed_sky.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

/// The sky between slopes, for kernels that add up what crowns hide of it.
/// Crowns cut by the vertical half-plane of an azimuth d, for sixteen receivers. u = p · d is the way to the axis along d and
/// v = p × d the way beside it, where p leads from the receiver to the axis in the plan; e = a² − v²; q = |p|² − a² is negative
/// where the receiver stands below, above or in the crown. docs/concepts.md, "Crowns".

namespace farlod {

/// What normals that all point straight up see at an azimuth: A(t) = 1 / (1 + t²).
struct SkyStraightUp {
  // Members as SkyOfNormals has them. NOLINTBEGIN(readability-convert-member-functions-to-static)
  FARLOD_LANES SlopeInterval in_front() const { return {broadcast(0.0F), broadcast(straight_up)}; }
  /// A(t) − A(s), which loses nothing to rounding where both are near each other.
  FARLOD_LANES Floats between(const Floats& t, const Floats& s) const {
    const Floats t_square = t * t, s_square = s * s;
    return (s_square - t_square) / ((1.0F + t_square) * (1.0F + s_square));
  }
  /// −dA/dy of y = sin²θ, at the slope t.
  FARLOD_LANES Floats density(const Floats&) const { return broadcast(1.0F); }
  // NOLINTEND(readability-convert-member-functions-to-static)
};

/// What any normals see at an azimuth.
struct SkyOfNormals {
  Floats outward, upward;
  FARLOD_LANES SlopeInterval in_front() const { return slopes_in_front(outward, upward); }
  FARLOD_LANES Floats between(const Floats& t, const Floats& s) const {
    return max(cosine_above(t, outward, upward) - cosine_above(s, outward, upward), broadcast(0.0F));
  }
  FARLOD_LANES Floats density(const Floats& t) const { return max(upward + outward / t, broadcast(0.0F)); }
};

template <class Sky>
FARLOD_LANES Sky sky_at(const Normals& normals, float cosine, float sine);
template <>
FARLOD_LANES SkyStraightUp sky_at(const Normals&, float, float) {
  return {};
}
template <>
FARLOD_LANES SkyOfNormals sky_at(const Normals& n, float cosine, float sine) {
  return {n.x * cosine + n.y * sine, n.z};
}

/// Some slopes of an azimuth of which receivers see a share: the sky above the horizon, or a gap.
struct SkyWindow {
  Floats from, to, weight;
};

/// Where the sky above the horizon begins.
FARLOD_LANES Floats begin_above(const SkyRows& rows, std::size_t k, const SlopeInterval& in_front) {
  return min(max(load(rows.sky_from + k * lane_count), in_front.lowest), in_front.highest);
}

/// The sky above the horizon. Its weight makes what is above the horizon's slope as much as what the jumps leave of it.
template <class Sky>
FARLOD_LANES SkyWindow window_above(const SkyRows& rows, std::size_t k, const Sky& sky) {
  const SlopeInterval in_front = sky.in_front();
  const Floats from = begin_above(rows, k, in_front);
  if (rows.sky == nullptr) return {from, in_front.highest, broadcast(1.0F)};
  const Floats all = sky.between(from, in_front.highest), known = load(rows.sky + k * lane_count);
  const Mask is_some = all > 0.0F;
  return {from, in_front.highest, choose(is_some, known / choose(is_some, all, broadcast(1.0F)), broadcast(0.0F))};
}

/// A gap, of whose sky a share is seen: the same share of what crowns take of it.
template <class Sky>
FARLOD_LANES SkyWindow window_of_gap(const SkyRows& rows, std::size_t k, const Sky& sky) {
  const SlopeInterval in_front = sky.in_front();
  const Floats share = load(rows.gap_share + k * lane_count);
  const Floats from = min(max(load(rows.gap_from + k * lane_count), in_front.lowest), in_front.highest),
               to = min(max(load(rows.gap_to + k * lane_count), from), in_front.highest);
  return {from, choose(share > 0.0F, to, from), share};
}

/// Where sky begins that counts: above the horizon, or in a gap below it.
FARLOD_LANES Floats ground_of(const Floats& above, const SkyWindow& gap) {
  return choose(gap.to > gap.from, min(gap.from, above), above);
}

/// The sky of a window between the slopes low and high, as weighted.
template <class Sky>
FARLOD_LANES Floats sky_within(const SkyWindow& window, const Sky& sky, const Floats& low, const Floats& high) {
  const Floats from = min(max(low, window.from), window.to), to = min(max(high, from), window.to);
  if (bits_of(to > from) == 0) return Floats{};
  return choose(to > from, window.weight * sky.between(from, to), broadcast(0.0F));
}

/// Tells the slopes between `from` and `to` to those who ask, for the receivers that see sky there.
FARLOD_LANES void tell_dimmed(const DimmedTaker& taker, std::uint32_t azimuth, const Floats& seen, const Floats& from,
                              const Floats& to, const Floats* lost) {
  if (taker.take == nullptr) return;
  const std::uint32_t lanes = bits_of(seen > 0.0F);
  if (lanes == 0) return;
  alignas(64) float low[lane_count], high[lane_count], shares[lane_count];
  store(from, low);
  store(to, high);
  if (lost != nullptr) store(*lost, shares);
  taker.take(taker.to, azimuth, lanes, low, high, lost != nullptr ? shares : nullptr);
}

/// Beyond each slope that counts. A root r, which is at least a/100 where this is multiplied by it, keeps it so.
inline constexpr float beyond_slopes = 1e10F;

/// Slopes between which a receiver sees a crown, none if low > high, and where: u and e of a spheroid; the distances in the plan
/// at which others are entered and left.
struct CutCrown {
  Floats low, high, near, far;
};

/// The places of the receivers, one a lane.
struct Eyes {
  Floats x, y, z;
};
FARLOD_LANES Eyes eyes_of(const ReceiverPacket& r) { return {load(r.x.data()), load(r.y.data()), load(r.z.data())}; }

/// A crown that is round in the plan. At an azimuth, low = u · low_u − r · low_r and high = u · high_u + r · high_r with r = √e.
struct RoundCrown {
  Floats x, y, q, low_u, low_r, high_u, high_r;
};

/// p, and q, which is kept off 0, where the formulas have no value: as if the radius were larger or smaller by 5e-5 of it.
FARLOD_LANES void set_place(const CrownBatches::Batch& b, std::size_t lane, const Eyes& eye, RoundCrown& c) {
  c.x = b.x[lane] - eye.x;
  c.y = b.y[lane] - eye.y;
  const float square = b.half_width[lane] * b.half_width[lane], least = 1e-4F * square;
  const Floats q = c.x * c.x + c.y * c.y - square;
  c.q = choose(abs(q) < least, choose(q < 0.0F, broadcast(-least), broadcast(least)), q);
}

/// An axis out of range: no slope, as high < low.
FARLOD_LANES void forget_beyond(const Floats& distance_square, float range_square, RoundCrown& c) {
  const Mask is_beyond = distance_square > range_square;
  c.high_u = choose(is_beyond, broadcast(0.0F), c.high_u);
  c.high_r = choose(is_beyond, broadcast(-beyond_slopes), c.high_r);
}

/// The tangents of a spheroid: t = u h / q ∓ r s / q with s = √(h² + q c²/a²), where h leads up to its centre.
FARLOD_LANES void set_spheroid(const CrownBatches::Batch& b, std::size_t lane, const Eyes& eye, RoundCrown& c) {
  set_place(b, lane, eye, c);
  const float half_height = 0.5F * (b.top[lane] - b.bottom[lane]), ratio = half_height / b.half_width[lane];
  const Floats h = b.bottom[lane] + half_height - eye.z, s_square = h * h + c.q * (ratio * ratio);
  const Floats inverse = 1.0F / c.q, to_centre = h * inverse, aside = sqrt(max(s_square, broadcast(0.0F))) * inverse;
  // Outside of the plan, both tangents count. Within it, an eye below sees the crown from a tangent up to the zenith, one above
  // it (and below its highest point) up to a tangent, and one inside in all directions
  const Mask in_plan = c.q < 0.0F, inside = max(c.q, s_square) < 0.0F;
  const Mask up_to_zenith = choose(inside, broadcast(1.0F), choose(in_plan, h, broadcast(-1.0F))) > 0.0F,
             down_to_level = choose(inside, broadcast(1.0F), choose(in_plan, -h, broadcast(-1.0F))) > 0.0F;
  c.low_u = choose(down_to_level, broadcast(0.0F), to_centre);
  c.low_r = choose(down_to_level, broadcast(beyond_slopes), aside);
  c.high_u = choose(up_to_zenith, broadcast(0.0F), to_centre);
  c.high_r = choose(up_to_zenith, broadcast(beyond_slopes), aside);
}

/// A cylinder is entered at u − r and left at u + r, whose product is q: bottom / (u + r) = bottom (u − r) / q, and
/// top / (u − r) = top (u + r) / q.
FARLOD_LANES void set_cylinder(const CrownBatches::Batch& b, std::size_t lane, const Eyes& eye, RoundCrown& c) {
  set_place(b, lane, eye, c);
  const Floats inverse = 1.0F / c.q, bottom = (b.bottom[lane] - eye.z) * inverse, rise = b.top[lane] - eye.z,
               top = rise * inverse;
  // An eye in the plan sees the crown up to the zenith, unless it is above. Inside, z₁ (u − r) / q is below the level, as it
  // should
  const Mask in_plan = c.q < 0.0F;
  const Floats to_zenith = choose(rise > 0.0F, broadcast(beyond_slopes), broadcast(-beyond_slopes));
  c.low_u = c.low_r = bottom;
  c.high_u = choose(in_plan, broadcast(0.0F), top);
  c.high_r = choose(in_plan, to_zenith, top);
}

FARLOD_LANES void set_round(const CrownBatches::Batch& b, std::size_t lane, const Eyes& eye, float range_square, RoundCrown& c) {
  b.shape[lane] == CrownShape::spheroid ? set_spheroid(b, lane, eye, c) : set_cylinder(b, lane, eye, c);
  forget_beyond(c.x * c.x + c.y * c.y, range_square, c);
}

// data() could be emitted on its own, for one target in the place of all. NOLINTBEGIN(readability-container-data-pointer)
FARLOD_LANES float* first_row(PlacedCrown& placed) { return &placed.rows[0][0]; }
FARLOD_LANES const float* first_row(const PlacedCrown& placed) { return &placed.rows[0][0]; }
// NOLINTEND(readability-container-data-pointer)

FARLOD_LANES void keep(const RoundCrown& c, PlacedCrown& placed) {
  placed.is_prism = false;
  float* row = first_row(placed);
  for (const Floats* member : {&c.x, &c.y, &c.q, &c.low_u, &c.low_r, &c.high_u, &c.high_r}) {
    store(*member, row);
    row += lane_count;
  }
}
FARLOD_LANES RoundCrown kept_round(const PlacedCrown& placed) {
  const float* const row = first_row(placed);
  return {load(row),
          load(row + lane_count),
          load(row + 2 * lane_count),
          load(row + 3 * lane_count),
          load(row + 4 * lane_count),
          load(row + 5 * lane_count),
          load(row + 6 * lane_count)};
}

/// The section of a round crown, where the azimuth meets it in front of the receiver.
FARLOD_LANES CutCrown cut_round(const RoundCrown& c, bool is_spheroid, float cosine, float sine) {
  const Floats u = c.x * cosine + c.y * sine, e = u * u - c.q, r = sqrt(max(e, broadcast(0.0F)));
  const Floats met = min(e, max(u, -c.q)), high = u * c.high_u + r * c.high_r;
  return {u * c.low_u - r * c.low_r, choose(met > 0.0F, high, broadcast(-1.0F)), is_spheroid ? u : u - r,
          is_spheroid ? e : u + r};
}

/// A prism, with p turned back by its turn.
struct SquareCrown {
  Floats x, y, bottom, top;
  float half_width, cosine, sine;
};
FARLOD_LANES void set_prism(const CrownBatches::Batch& b, std::size_t lane, const Eyes& eye, float range_square, SquareCrown& c) {
  const Floats x = b.x[lane] - eye.x, y = b.y[lane] - eye.y;
  c.half_width = b.half_width[lane];
  c.cosine = b.cosine[lane];
  c.sine = b.sine[lane];
  c.x = x * c.cosine + y * c.sine;
  c.y = y * c.cosine - x * c.sine;
  c.bottom = b.bottom[lane] - eye.z;
  // Out of range, it ends below the eye
  c.top = choose(x * x + y * y > range_square, broadcast(-1.0F), b.top[lane] - eye.z);
}

FARLOD_LANES void keep(const SquareCrown& c, PlacedCrown& placed) {
  placed.is_prism = true;
  placed.half_width = c.half_width;
  placed.cosine = c.cosine;
  placed.sine = c.sine;
  float* row = first_row(placed);
  for (const Floats* member : {&c.x, &c.y, &c.bottom, &c.top}) {
    store(*member, row);
    row += lane_count;
  }
}
FARLOD_LANES SquareCrown kept_square(const PlacedCrown& placed) {
  const float* const row = first_row(placed);
  return {load(row),
          load(row + lane_count),
          load(row + 2 * lane_count),
          load(row + 3 * lane_count),
          placed.half_width,
          placed.cosine,
          placed.sine};
}

/// 1 / x, and a large number in place of infinity, so that a side along the azimuth is entered far behind the eye, or not at all.
FARLOD_LANES float finite_inverse(float x) {
  constexpr float least = 1e-9F;
  return 1.0F / (x < 0.0F ? (x > -least ? -least : x) : (x < least ? least : x));
}

/// Slabs: each pair of sides is entered and left at (p ∓ a) / d; the square is entered at the last and left at the first of them.
FARLOD_LANES CutCrown cut_prism(const SquareCrown& c, float cosine, float sine) {
  constexpr float least_distance = 1e-6F;
  const float per_x = finite_inverse(cosine * c.cosine + sine * c.sine),
              per_y = finite_inverse(sine * c.cosine - cosine * c.sine);
  const float half_x = c.half_width * (per_x < 0.0F ? -per_x : per_x), half_y = c.half_width * (per_y < 0.0F ? -per_y : per_y);
  const Floats x = c.x * per_x, y = c.y * per_y;
  const Floats near = max(x - half_x, y - half_y), far = min(x + half_x, y + half_y);
  const Floats entered = max(near, broadcast(least_distance));
  const Mask is_met = far > entered;
  // An eye in the square enters it at once, and sees it up to the zenith if it reaches above the eye
  return {c.bottom / choose(is_met, far, broadcast(1.0F)), choose(is_met, c.top / entered, broadcast(-1.0F)), near, far};
}

FARLOD_LANES std::uint32_t next_azimuth(std::uint32_t k, std::uint32_t size) { return k + 1 < size ? k + 1 : 0; }

/// Cuts a crown at its azimuths: `visitor.visit(seen, k, cut)`, unless `visitor.skips(seen, k)`.
template <class Visitor>
FARLOD_LANES void cut_crown(const CrownScene& scene, const SeenCrown& seen, const Eyes& eye, const Visitor& visitor) {
  const CrownBatches::Batch& b = scene.batches[seen.crown / lane_count];
  const std::size_t lane = seen.crown % lane_count;
  const AzimuthView& a = scene.azimuths;
  std::uint32_t k = seen.first;
  if (b.shape[lane] == CrownShape::prism) {
    SquareCrown crown;
    set_prism(b, lane, eye, scene.range_square, crown);
    for (std::uint32_t n = 0; n < seen.count; ++n, k = next_azimuth(k, a.size))
      if (!visitor.skips(seen, k)) visitor.visit(seen, k, cut_prism(crown, a.cosine[k], a.sine[k]));
    return;
  }
  const bool is_spheroid = b.shape[lane] == CrownShape::spheroid;
  RoundCrown crown;
  set_round(b, lane, eye, scene.range_square, crown);
  for (std::uint32_t n = 0; n < seen.count; ++n, k = next_azimuth(k, a.size))
    if (!visitor.skips(seen, k)) visitor.visit(seen, k, cut_round(crown, is_spheroid, a.cosine[k], a.sine[k]));
}

}  // namespace farlod
