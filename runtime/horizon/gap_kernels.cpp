// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_kernels.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "horizon/facet_culling.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

using Batch = OverhangFacets::Batch;
constexpr float infinite = std::numeric_limits<float>::infinity();

// --- Which facets matter
// ------------------------------------------------------------------------------------------------------------

void find_gaps(const float* sky, std::size_t azimuth_count, std::uint16_t* receivers) {
  for (std::size_t k = 0; k < azimuth_count; ++k)
    receivers[k] = static_cast<std::uint16_t>(bits_of(load(sky + k * lane_count) > 0.0F));
}

void find_lowest(std::span<const float* const> horizons, const AzimuthView& azimuths, LowestOfSectors& lowest) {
  SectorMinHorizon found;
  find_sector_minima(horizons, azimuths, SectorAzimuths::inside, found);
  lowest = found.minima;
}

void find_above(const FacetsInBoxes& facets, const PacketBounds& bounds, const LowestOfSectors& lowest, std::uint16_t* found) {
  const SectorMinHorizon horizon{lowest};
  for (std::size_t n = 0; n < facets.batches.size(); ++n) found[n] = 0;
  for (std::size_t n = 0; n < facets.boxes.size(); ++n)
    for (std::uint32_t boxes = raising_edges(reach_of_boxes(facets.boxes[n], bounds), horizon); boxes != 0; boxes &= boxes - 1) {
      const std::size_t batch = n * lane_count + static_cast<std::size_t>(std::countr_zero(boxes));
      if (batch >= facets.batches.size()) break;
      found[batch] = static_cast<std::uint16_t>(raising_edges(reach_of_facets(facets.batches[batch], bounds), horizon));
    }
}

void find_bins(std::span<const Batch> facets, const CenteredBox& box, const std::uint16_t* found, std::int32_t* bins_of_facets) {
  constexpr auto sectors = static_cast<std::int32_t>(GapKernels::sectors_of_ring);
  for (std::size_t number = 0; number < facets.size(); ++number) {
    if (found[number] == 0) continue;
    const Batch& batch = facets[number];
    // The distance of the box around a facet, and the azimuth of its middle
    Floats low_x = broadcast(infinite), low_y = low_x, high_x = broadcast(-infinite), high_y = high_x;
    for (std::size_t n = 0; n < 3; ++n) {
      const Floats x = load(batch.x[n].data()) - box.x, y = load(batch.y[n].data()) - box.y;
      low_x = min(low_x, x);
      low_y = min(low_y, y);
      high_x = max(high_x, x);
      high_y = max(high_y, y);
    }
    const Floats x = max(max(low_x, -high_x), broadcast(0.0F)), y = max(max(low_y, -high_y), broadcast(0.0F));
    // Two rings from each distance of at least 4 m to its double: the exponent of its square
    const Ints ring = floor_log2(truncate(min(x * x + y * y, broadcast(1e9F)) * 0.0625F) + 1);
    const Ints sector = truncate(pseudo_angle(low_x + high_x, low_y + high_y) * static_cast<float>(sectors));
    store(ring * broadcast(sectors) + (sector & (sectors - 1)), bins_of_facets + number * lane_count);
  }
}

// --- What they hide
// -----------------------------------------------------------------------------------------------------------------

/// Where gaps are seen from, and at which azimuths.
struct Eyes {
  Floats x, y, z, cosine, sine;
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

/// The section of a facet is the line between two places on its edges. What is nearer than least_distance_m counts as behind the
/// eye; a section that passes over the eye hides all above its other end, and one that passes under it all below. Nothing is said
/// of sections that are not between the slopes `from` and `to`.
FARLOD_LANES HiddenSlopes section_of(const Batch& facets, std::size_t lane, const Eyes& eyes, const Floats& from,
                                     const Floats& to) {
  const HiddenSlopes nothing{broadcast(infinite), broadcast(infinite)};
  Corner c[3];
  for (std::size_t n = 0; n < 3; ++n) {
    const Floats x = facets.x[n][lane] - eyes.x, y = facets.y[n][lane] - eyes.y;
    c[n] = {x * eyes.sine - y * eyes.cosine, x * eyes.cosine + y * eyes.sine, facets.z[n][lane] - eyes.z};
  }
  const Floats rightmost = max(max(c[0].aside, c[1].aside), c[2].aside), leftmost = min(min(c[0].aside, c[1].aside), c[2].aside);
  // What lies on the azimuth is to the right of it
  const Mask is_cut = choose(leftmost < 0.0F, rightmost, broadcast(-1.0F)) >= 0.0F;
  if (bits_of(is_cut) == 0) return nothing;
  // The corner that is alone on its side
  const Floats right0 = side_of(c[0].aside), right1 = side_of(c[1].aside), right2 = side_of(c[2].aside);
  const Mask third_alone = right0 == right1, second_alone = right0 == right2;
  const Corner alone = choose(third_alone, c[2], choose(second_alone, c[1], c[0]));
  const Corner first = choose(third_alone, c[0], choose(second_alone, c[2], c[1]));
  const Corner second = choose(third_alone, c[1], choose(second_alone, c[0], c[2]));
  const Meeting m = meeting_of(alone, first), n = meeting_of(alone, second);
  const Floats m_ahead = m.ahead - least_distance_m * m.weight, n_ahead = n.ahead - least_distance_m * n.weight;
  // Most sections are hidden already, or behind the eye: no division tells
  const Floats nearer = min(m_ahead, n_ahead), farther = max(m_ahead, n_ahead);
  const Floats above_from = max(m.up - from * m.ahead, n.up - from * n.ahead),
               below_to = max(to * m.ahead - m.up, to * n.ahead - n.up);
  const Floats inside = choose(nearer > 0.0F, min(above_from, below_to), farther);
  const Mask is_inside = choose(is_cut, inside, broadcast(-1.0F)) > 0.0F;
  if (bits_of(is_inside) == 0) return nothing;
  const Floats m_slope = m.up / m.ahead, n_slope = n.up / n.ahead;
  // Over or under the eye: the sign of (up_m ahead_n − up_n ahead_m) where n is in front. What touches the eye is under it: up to
  // least_distance_m above
  const Mask n_in_front = n_ahead > 0.0F;
  const Floats front_slope = choose(n_in_front, n_slope, m_slope);
  const Floats m_up = m.up - least_distance_m * m.weight, n_up = n.up - least_distance_m * n.weight;
  const Mask is_over = choose(n_in_front, m_up * n.ahead - n_up * m.ahead, n_up * m.ahead - m_up * n.ahead) > 0.0F;
  const Mask is_past = nearer <= 0.0F;
  const Floats past_low = choose(is_over, front_slope, broadcast(0.0F)),
               past_high = choose(is_over, broadcast(infinite), front_slope);
  return {choose(is_inside, choose(is_past, past_low, min(m_slope, n_slope)), nothing.low),
          choose(is_past, past_high, max(m_slope, n_slope))};
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
    to = choose(hidden.high >= to, min(to, hidden.low), to);
    if (bits_of(reached_by(hidden)) == 0) return;
    store(hidden.low, room + 2 * count * lane_count);
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

/// A(t) at the azimuths of gaps.
struct SkyOfGaps {
  Floats outward, upward;
  SlopeInterval in_front;
  bool is_solid;
  FARLOD_LANES SkyOfGaps(const GapBlock& gaps, bool solid)
      : outward(load(gaps.normal_x.data()) * load(gaps.cosine.data()) + load(gaps.normal_y.data()) * load(gaps.sine.data())),
        upward(load(gaps.normal_z.data())),
        in_front(slopes_in_front(outward, upward)),
        is_solid(solid) {}
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
    const Mask is_open = t < gaps.to;
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
  Side first, last;
  float low_z, high_z;             ///< of the receivers
  float floor = 0.0F, lid = 0.0F;  ///< the lowest and the highest slope of their gaps

  FARLOD_LANES WedgeOfGaps(const GapBlock& gaps, const Eyes& eyes)
      : first{gaps.cosine[0], gaps.sine[0], 0.0F, 0.0F, 0.0F},
        last{gaps.cosine[lane_count - 1], gaps.sine[lane_count - 1], 0.0F, 0.0F, 0.0F},
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
  [[nodiscard]] FARLOD_LANES std::uint32_t met(const Batch& facets) const {
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
  /// Between two azimuths, at most 30° apart, no place is farther ahead than along one of them times this: 1 / cos 15°.
  static constexpr float widest = 1.036F;
};

// What is stored in `room` is not seen here. NOLINTNEXTLINE(readability-non-const-parameter)
void find_open(const FacetsInBoxes& facets, bool is_solid, float* room, GapBlock& gaps) {
  const Eyes eyes{load(gaps.x.data()), load(gaps.y.data()), load(gaps.z.data()), load(gaps.cosine.data()),
                  load(gaps.sine.data())};
  NarrowingGaps left{load(gaps.from.data()), load(gaps.to.data()), room};
  left.hide({load(gaps.hidden_from.data()), load(gaps.hidden_to.data())});
  WedgeOfGaps wedge(gaps, eyes);
  const auto first_lane = [](std::uint32_t bits) { return static_cast<std::size_t>(std::countr_zero(bits)); };
  for (std::size_t n = 0; n < facets.boxes.size() && wedge.set_slopes(left.from, left.to); ++n)
    for (std::uint32_t boxes = wedge.met(facets.boxes[n]); boxes != 0; boxes &= boxes - 1) {
      const std::size_t number = n * lane_count + first_lane(boxes);
      if (number >= facets.batches.size() || !wedge.set_slopes(left.from, left.to)) break;
      const Batch& batch = facets.batches[number];
      for (std::uint32_t met = wedge.met(batch); met != 0; met &= met - 1)
        left.hide(section_of(batch, first_lane(met), eyes, left.from, left.to));
    }
  const Open open = open_of(left, SkyOfGaps(gaps, is_solid));
  store(open.sky, gaps.sky.data());
  store(open.from, gaps.from.data());
  store(open.to, gaps.to.data());
  store(open.split, gaps.is_split.data());
}

}  // namespace

namespace FARLOD_TARGET {
extern const GapKernels gap_kernels;
constexpr GapKernels gap_kernels{
    .find_gaps = find_gaps, .find_lowest = find_lowest, .find_above = find_above, .find_bins = find_bins, .find_open = find_open};
}  // namespace FARLOD_TARGET

}  // namespace farlod
