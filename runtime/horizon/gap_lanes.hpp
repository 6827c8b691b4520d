// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "horizon/gap_kernels.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

/// What kernels know of gaps below overhangs, and of the facets that hide some of them.
namespace farlod {

inline constexpr float infinite = std::numeric_limits<float>::infinity();

/// Where gaps are seen from, and at which azimuths.
struct GapEyes {
  Floats x, y, z, cosine, sine;

  FARLOD_LANES explicit GapEyes(const EyeBlock& e)
      : x(load(e.x.data())), y(load(e.y.data())), z(load(e.z.data())), cosine(load(e.cosine.data())), sine(load(e.sine.data())) {}
};

/// The slopes that a facet hides, or low = infinite; `high` is no number then where an azimuth runs along a facet. So it is the
/// first operand of max, which gives the second one for it: nothing else may come before an end that is infinite already.
struct HiddenSlopes {
  Floats low, high;
};

/// A corner of a facet from an eye: to the right of an azimuth, along it, and above the eye.
struct Corner {
  Floats aside, ahead, up;
};
FARLOD_LANES Corner choose(const Mask& mask, const Corner& a, const Corner& b) {
  return {choose(mask, a.aside, b.aside), choose(mask, a.ahead, b.ahead), choose(mask, a.up, b.up)};
}

/// The corners of a facet.
FARLOD_LANES void find_corners(const OverhangFacets::Batch& facets, std::size_t lane, const GapEyes& eyes, Corner (&c)[3]) {
  for (std::size_t n = 0; n < 3; ++n) {
    const Floats x = facets.x[n][lane] - eyes.x, y = facets.y[n][lane] - eyes.y;
    c[n] = {x * eyes.sine - y * eyes.cosine, x * eyes.cosine + y * eyes.sine, facets.z[n][lane] - eyes.z};
  }
}

/// 1 to the right of an azimuth, and on it; else −1.
FARLOD_LANES Floats side_of(const Floats& aside) { return choose(aside >= 0.0F, broadcast(1.0F), broadcast(-1.0F)); }

/// Where the half-plane at an azimuth, or its back, meets the edge between corners on both sides of it: ahead = D / w and up =
/// N / w. All terms of w have one sign, and so have those of D and N wherever both corners do: nothing cancels out. It is the
/// same to the bit for the facets on both sides of the edge.
struct Meeting {
  Floats ahead, up, weight;
};
FARLOD_LANES Meeting meeting_of(const Corner& a, const Corner& b) {
  const Floats wa = abs(b.aside), wb = abs(a.aside);
  return {a.ahead * wa + b.ahead * wb, a.up * wa + b.up * wb, wa + wb};
}

/// Where an azimuth cuts a facet: the section is the line between two places on its edges.
struct Cut {
  Mask is_cut;
  Meeting m, n;
};
/// Whether some azimuth cuts the facet. What lies on an azimuth is to the right of it.
FARLOD_LANES bool find_cut(const Corner (&c)[3], Cut& cut) {
  const Floats rightmost = max(max(c[0].aside, c[1].aside), c[2].aside), leftmost = min(min(c[0].aside, c[1].aside), c[2].aside);
  cut.is_cut = choose(leftmost < 0.0F, rightmost, broadcast(-1.0F)) >= 0.0F;
  if (bits_of(cut.is_cut) == 0) return false;
  // The corner that is alone on its side
  const Floats right0 = side_of(c[0].aside), right1 = side_of(c[1].aside), right2 = side_of(c[2].aside);
  const Mask third_alone = right0 == right1, second_alone = right0 == right2;
  const Corner alone = choose(third_alone, c[2], choose(second_alone, c[1], c[0]));
  cut.m = meeting_of(alone, choose(third_alone, c[0], choose(second_alone, c[2], c[1])));
  cut.n = meeting_of(alone, choose(third_alone, c[1], choose(second_alone, c[0], c[2])));
  return true;
}

/// Gaps from `from` up to `to`, which narrow as what is hidden in them becomes known, and what is hidden in between.
struct NarrowingGaps {
  Floats from, to;
  float* room;  ///< for low and high of each section in between
  std::size_t count = 0;

  /// Lanes with a gap into which these slopes reach.
  [[nodiscard]] FARLOD_LANES Mask reached_by(const HiddenSlopes& hidden) const {
    return max(hidden.low, from) < min(hidden.high, to);
  }
  FARLOD_LANES void hide(const HiddenSlopes& hidden) {
    if (bits_of(reached_by(hidden)) == 0) return;
    from = choose(hidden.low <= joined(from), max(hidden.high, from), from);
    to = choose(joined(hidden.high) >= to, max(min(to, hidden.low), from), to);
    const Mask is_between = reached_by(hidden);
    if (bits_of(is_between) == 0) return;
    store(choose(is_between, hidden.low, broadcast(infinite)), room + 2 * count * lane_count);
    store(hidden.high, room + (2 * count + 1) * lane_count);
    ++count;
  }
  [[nodiscard]] FARLOD_LANES Floats low(std::size_t n) const { return load(room + 2 * n * lane_count); }
  [[nodiscard]] FARLOD_LANES Floats high(std::size_t n) const { return load(room + (2 * n + 1) * lane_count); }

  /// The slope up to which all is hidden from a slope on.
  [[nodiscard]] FARLOD_LANES Floats hidden_from(Floats t) const {
    for (;;) {
      const Floats reached = joined(t);
      Floats end = t;
      for (std::size_t n = 0; n < count; ++n) end = max(choose(low(n) <= reached, high(n), t), end);
      if (bits_of(end > t) == 0) return t;
      t = end;
    }
  }
  /// The slope at which the next section begins, at most `to`.
  [[nodiscard]] FARLOD_LANES Floats next_after(const Floats& t) const {
    Floats next = to;
    for (std::size_t n = 0; n < count; ++n) next = min(next, choose(low(n) > t, low(n), to));
    return next;
  }
  /// Ends that differ by rounding are one: many roundings of a slope, of a difference, a product, a sum and a division each.
  static FARLOD_LANES Floats joined(const Floats& t) { return t + 1e-5F * (1.0F + t); }
};

struct Open {
  Floats sky, from, to, split;
};

/// A(t) at an azimuth along which normals point outward so far.
struct SkyOfGaps {
  Floats outward, upward;
  SlopeInterval in_front;
  bool is_solid;
  FARLOD_LANES SkyOfGaps(const Floats& outward_part, const Floats& upward_part, bool solid)
      : outward(outward_part), upward(upward_part), in_front(slopes_in_front(outward, upward)), is_solid(solid) {}
  [[nodiscard]] FARLOD_LANES Floats above(const Floats& slope) const {
    const Floats t = min(max(slope, in_front.lowest), in_front.highest);
    return is_solid ? solid_angle_above(t) : cosine_above(t, outward, upward);
  }
};

/// What is open in gaps, from below.
FARLOD_LANES Open open_of(const NarrowingGaps& gaps, const SkyOfGaps& sky) {
  const Floats from = gaps.from;
  Open open{Floats{}, from, from, Floats{}};
  Floats t = from;
  for (;;) {
    t = min(gaps.hidden_from(t), gaps.to);
    const Mask is_open = gaps.joined(t) < gaps.to;
    if (bits_of(is_open) == 0) return open;
    const Floats next = choose(is_open, gaps.next_after(t), t);
    open.sky += choose(is_open, max(sky.above(t) - sky.above(next), broadcast(0.0F)), broadcast(0.0F));
    const Mask is_first = open.to == from;
    open.split = choose(is_open, choose(is_first, open.split, broadcast(1.0F)), open.split);
    open.from = choose(is_open, choose(is_first, t, open.from), open.from);
    open.to = choose(is_open, next, open.to);
    t = next;
  }
}

/// The wedge between the first and the last azimuth of some gaps, seen from all their receivers. A place is beside it if it is to
/// the right of the first azimuth from all of them, or to the left of the last one. At an azimuth in between it is no nearer than
/// the least that it is ahead along both, and little farther than the most: (cos φ, sin φ) is a sum of both directions with
/// shares ≥ 0 that sum to at least 1, and to at most 1 / cos of half their angle.
class WedgeOfGaps {
 public:
  struct Side {
    float cosine, sine;
    float aside_m;            ///< of the receiver that is farthest aside
    float ahead_m, behind_m;  ///< of the receivers farthest ahead and behind

    [[nodiscard]] FARLOD_LANES Floats aside(const Floats& x, const Floats& y) const { return x * sine - y * cosine; }
    [[nodiscard]] FARLOD_LANES Floats ahead(const Floats& x, const Floats& y) const { return x * cosine + y * sine; }
  };
  struct Direction {
    float cosine, sine;
  };
  Side first, last;
  float low_z, high_z;             ///< of the receivers
  float floor = 0.0F, lid = 0.0F;  ///< the lowest and the highest slope of their gaps

  FARLOD_LANES WedgeOfGaps(const Direction& from, const Direction& to, const GapEyes& eyes)
      : first{from.cosine, from.sine, 0.0F, 0.0F, 0.0F},
        last{to.cosine, to.sine, 0.0F, 0.0F, 0.0F},
        low_z(min_lane(eyes.z) - margin_m),
        high_z(max_lane(eyes.z) + margin_m) {
    first.aside_m = max_lane(first.aside(eyes.x, eyes.y)) + margin_m;
    last.aside_m = min_lane(last.aside(eyes.x, eyes.y)) - margin_m;
    for (Side* side : {&first, &last}) {
      const Floats ahead = side->ahead(eyes.x, eyes.y);
      side->ahead_m = max_lane(ahead) + margin_m;
      side->behind_m = min_lane(ahead) - margin_m;
    }
  }
  /// Whether there are gaps.
  [[nodiscard]] FARLOD_LANES bool set_slopes(const Floats& from, const Floats& to) {
    const Mask is_gap = from < to;
    if (bits_of(is_gap) == 0) return false;
    floor = min_lane(choose(is_gap, from, broadcast(infinite)));
    lid = max_lane(choose(is_gap, to, broadcast(-infinite)));
    return true;
  }

  /// The boxes that may hold such facets: a bit for each. At right angles to an azimuth, a box reaches as far from its middle as
  /// half its sides add up to.
  [[nodiscard]] FARLOD_LANES std::uint32_t met(const OverhangFacets::Boxes& boxes) const {
    const Floats low_x = load(boxes.low_x.data()), low_y = load(boxes.low_y.data());
    const Floats half_x = 0.5F * (load(boxes.high_x.data()) - low_x), half_y = 0.5F * (load(boxes.high_y.data()) - low_y);
    const Floats x = low_x + half_x, y = low_y + half_y;
    const Floats first_aside = half_x * abs_of(first.sine) + half_y * abs_of(first.cosine),
                 last_aside = half_x * abs_of(last.sine) + half_y * abs_of(last.cosine);
    const Floats first_ahead = half_x * abs_of(first.cosine) + half_y * abs_of(first.sine),
                 last_ahead = half_x * abs_of(last.cosine) + half_y * abs_of(last.sine);
    const Floats along_first = first.ahead(x, y), along_last = last.ahead(x, y);
    return met({first.aside(x, y) - first_aside, last.aside(x, y) + last_aside,
                min(along_first - first_ahead - first.ahead_m, along_last - last_ahead - last.ahead_m),
                max(along_first + first_ahead - first.behind_m, along_last + last_ahead - last.behind_m),
                load(boxes.low_z.data()), load(boxes.high_z.data())});
  }
  /// The facets of a batch that may be met between floor and lid: a bit for each.
  [[nodiscard]] FARLOD_LANES std::uint32_t met(const OverhangFacets::Batch& facets) const {
    Reach reach{broadcast(infinite),  broadcast(-infinite), broadcast(infinite),
                broadcast(-infinite), broadcast(infinite),  broadcast(-infinite)};
    for (std::size_t n = 0; n < 3; ++n) {
      const Floats x = load(facets.x[n].data()), y = load(facets.y[n].data());
      reach.right = min(reach.right, first.aside(x, y));
      reach.left = max(reach.left, last.aside(x, y));
      const Floats along_first = first.ahead(x, y), along_last = last.ahead(x, y), z = load(facets.z[n].data());
      reach.nearest = min(reach.nearest, min(along_first - first.ahead_m, along_last - last.ahead_m));
      reach.farthest = max(reach.farthest, max(along_first - first.behind_m, along_last - last.behind_m));
      reach.lowest = min(reach.lowest, z);
      reach.highest = max(reach.highest, z);
    }
    return met(reach);
  }

 private:
  /// How far things reach: to the right of the first azimuth at the least, to the left of the last one, ahead, and up.
  struct Reach {
    Floats right, left, nearest, farthest, lowest, highest;
  };
  [[nodiscard]] FARLOD_LANES std::uint32_t met(const Reach& r) const {
    // Whether rise / nearest > floor, or it is too near to tell; and whether the least rise / farthest < lid
    const Floats above_floor = max((r.highest - low_z) - floor * r.nearest, -r.nearest), least_rise = r.lowest - high_z;
    const Floats below_lid = max(lid * (widest * r.farthest) - least_rise, -least_rise);
    return bits_of(min(min(first.aside_m - r.right, r.left - last.aside_m), min(above_floor, below_lid)) > 0.0F);
  }

  static FARLOD_LANES float abs_of(float x) { return x < 0.0F ? -x : x; }
  /// Many times the rounding of coordinates.
  static constexpr float margin_m = 0.01F;
  /// Between two azimuths, at most 45° apart, no place is farther ahead than along one of them times this: 1 / cos 22.5°.
  static constexpr float widest = 1.083F;
};

/// Calls visit(batch, lane) for each facet that may be met in a wedge, while is_left().
template <class Left, class Visit>
FARLOD_LANES void visit_met(const FacetsInBoxes& facets, const WedgeOfGaps& wedge, const Left& is_left, const Visit& visit) {
  for (std::size_t n = 0; n < facets.boxes.size() && is_left(); ++n)
    for (std::uint32_t boxes = wedge.met(facets.boxes[n]); boxes != 0; boxes &= boxes - 1) {
      const std::size_t number = n * lane_count + static_cast<std::size_t>(std::countr_zero(boxes));
      if (number >= facets.batches.size() || !is_left()) break;
      const OverhangFacets::Batch& batch = facets.batches[number];
      for (std::uint32_t met = wedge.met(batch); met != 0; met &= met - 1)
        visit(batch, static_cast<std::size_t>(std::countr_zero(met)));
    }
}

}  // namespace farlod
