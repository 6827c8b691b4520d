// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstddef>
#include <cstdint>

#include "horizon/gap_kernels.hpp"
#include "horizon/gap_lanes.hpp"
#include "horizon/lanes.hpp"
#include "horizon/wedge_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

/// A facet that comes so close to an eye, in the plan or above and below it, may hide anything there: rounding of coordinates
/// would tell.
constexpr float near_m = 0.005F;
/// Above all slopes, and finite, so that differences are numbers.
constexpr float beyond = 1e20F;

/// Slopes of the places of a facet in a wedge, from the lowest to the highest one; and the distance of the nearest one.
struct FacetInWedge {
  Floats low = broadcast(beyond), high = broadcast(-beyond), nearest = broadcast(beyond);

  FARLOD_LANES void add(const Mask& is_there, const Floats& lower, const Floats& higher, const Floats& distance) {
    low = min(choose(is_there, lower, low), low);
    high = max(choose(is_there, higher, high), high);
    nearest = min(choose(is_there, distance, nearest), nearest);
  }
};

/// The slopes that a facet hides at an azimuth: none where `low` is beyond.
struct Section {
  Floats low, high;
};

/// Adds a facet's section at an azimuth, and returns what it hides there at least.
FARLOD_LANES Section add_section(const Corner (&corners)[3], FacetInWedge& facet) {
  Section section{broadcast(beyond), broadcast(-beyond)};
  Cut cut;
  if (!find_cut(corners, cut)) return section;
  const Floats zero = broadcast(0.0F), one = broadcast(1.0F), near = broadcast(near_m);
  const Floats m_ahead = cut.m.ahead / cut.m.weight, n_ahead = cut.n.ahead / cut.n.weight;
  const Floats m_up = cut.m.up / cut.m.weight, n_up = cut.n.up / cut.n.weight;
  const Mask n_is_farther = n_ahead > m_ahead;
  const Floats nearer = min(m_ahead, n_ahead), farther = max(m_ahead, n_ahead);
  const Floats nearer_up = choose(n_is_farther, m_up, n_up), farther_up = choose(n_is_farther, n_up, m_up);
  // What is behind the eye is not in the wedge
  const Mask is_ahead = choose(cut.is_cut, choose(farther < -near, zero, one), zero) > 0.0F;
  const Floats far_slope = farther_up / max(farther, near), near_slope = nearer_up / max(nearer, near);
  // Over the eye it hides all above its farther end, and under the eye all below that
  const Floats over_m = (nearer_up * farther - farther_up * nearer) / max(farther - nearer, near);
  const Mask passes = max(nearer + near, near - farther) < 0.0F;
  const Floats passing_low = choose(over_m > 0.0F, far_slope, broadcast(-beyond)),
               passing_high = choose(over_m > 0.0F, broadcast(beyond), far_slope);
  const Floats low = choose(passes, passing_low, min(near_slope, far_slope)),
               high = choose(passes, passing_high, max(near_slope, far_slope));
  const Mask is_clear = choose(passes, abs(over_m), nearer) > near;
  const Mask is_known = choose(is_clear, choose(is_ahead, one, zero), zero) > 0.0F;
  const Floats anything = choose(max(nearer_up, farther_up) < -near, zero, broadcast(beyond));
  facet.add(is_ahead, choose(is_clear, low, zero), choose(is_clear, high, anything),
            choose(is_clear, choose(passes, farther, nearer), near));
  section.low = choose(is_known, low, section.low);
  section.high = choose(is_known, high, section.high);
  return section;
}

/// Seen from the last azimuth of a wedge.
FARLOD_LANES Corner turned(const Corner& c, const WedgeShape& w) {
  return {c.aside * w.cosine + c.ahead * w.sine, c.ahead * w.cosine - c.aside * w.sine, c.up};
}

/// A facet as receivers see it from both azimuths of their wedges. Coordinates are rounded by 8 µm, and what follows from them by
/// shares of themselves.
struct FacetSeen {
  Corner first[3], last[3];
  Floats blur_m;
};
/// Whether it reaches into some wedge, and may rise above a slope there: no place is farther ahead along an azimuth than it is
/// away.
FARLOD_LANES bool is_seen(const OverhangFacets::Batch& facets, std::size_t lane, const GapEyes& eyes, const WedgeShape& w,
                          const Floats& slopes, FacetSeen& facet) {
  find_corners(facets, lane, eyes, facet.first);
  Floats extent = broadcast(0.0F), right = broadcast(beyond), left = right, ahead = -right, above = -right, above_last = -right;
  for (std::size_t n = 0; n < 3; ++n) {
    const Corner &c = facet.first[n], &d = facet.last[n] = turned(c, w);
    extent = max(extent, max(abs(c.aside), abs(c.ahead)));
    right = min(right, c.aside);
    left = min(left, -d.aside);
    ahead = max(ahead, max(c.ahead, d.ahead));
    above = max(above, c.up - slopes * c.ahead);
    above_last = max(above_last, d.up - slopes * d.ahead);
  }
  facet.blur_m = 4e-5F + 4e-7F * extent;
  return bits_of(max(max(right, left), -min(ahead, min(above, above_last))) <= near_m) != 0;
}

struct CertainSlopes {
  HiddenSlopes at_most, at_least;
};
/// What a facet hides in a wedge, where it rises above a floor at an azimuth or with a corner. Its part of the picture plane is
/// convex: its lower border is no higher than at one of the azimuths, and its upper one no lower.
FARLOD_LANES CertainSlopes slopes_hidden(const FacetSeen& seen, const WedgeShape& w, const Floats& floor) {
  FacetInWedge facet;
  const Section a = add_section(seen.first, facet), b = add_section(seen.last, facet);
  for (std::size_t n = 0; n < 3; ++n) {
    const Corner& c = seen.first[n];
    const Mask is_inside = max(max(c.aside, -seen.last[n].aside), -c.ahead) <= seen.blur_m;
    const Floats distance = sqrt(c.aside * c.aside + c.ahead * c.ahead);
    const Mask is_clear = distance > near_m;
    const Floats slope = c.up / max(distance, broadcast(near_m));
    const Floats anything = choose(c.up < -near_m, slope, broadcast(beyond));
    facet.add(is_inside, min(slope, choose(is_clear, slope, broadcast(0.0F))), choose(is_clear, slope, anything),
              max(distance, broadcast(near_m)));
  }
  const Floats share = 2e-5F + seen.blur_m / facet.nearest, highest = w.widened * facet.high;
  const Floats low = w.widened * max(a.low, b.low), high = min(a.high, b.high);
  const Mask rises = facet.high > floor;
  const Floats nothing = broadcast(beyond);
  return {{choose(rises, facet.low - share * (1.0F + abs(facet.low)), nothing), highest + share * (1.0F + abs(highest))},
          {choose(rises, low + share * (1.0F + abs(low)), nothing), high - share * (1.0F + abs(high))}};
}

/// The least and the most that normals point outward at azimuths of the wedges: a sinusoid is concave where it is positive.
struct Outward {
  Floats least, most;
};
FARLOD_LANES Outward outward_of(const EyeBlock& block, const GapEyes& eyes, const WedgeShape& w) {
  const Floats x = load(block.normal_x.data()), y = load(block.normal_y.data());
  const Floats first = x * eyes.cosine + y * eyes.sine, left = y * eyes.cosine - x * eyes.sine;
  const Floats last = first * w.cosine + left * w.sine, least = min(first, last);
  return {choose(least < 0.0F, w.widened * least, least), most_outward(first, last, w)};
}

/// What facets leave of gaps: `open` is what none of them may reach, and `unhidden`, from `lid` on, what none certainly hides.
struct CertainGaps {
  NarrowingGaps open, unhidden;
  Floats below;
};
FARLOD_LANES void hide_facets(const FacetsInBoxes& facets, const WedgeShape& w, const WedgeGapBlock& gaps, const GapEyes& eyes,
                              CertainGaps& left) {
  const Floats from = load(gaps.from.data()), to = load(gaps.to.data()), lid = load(gaps.lid.data());
  const float cosine = gaps.eyes.cosine[lane_count - 1], sine = gaps.eyes.sine[lane_count - 1];
  WedgeOfGaps wedge({gaps.eyes.cosine[0], gaps.eyes.sine[0]},
                    {cosine * w.cosine - sine * w.sine, sine * w.cosine + cosine * w.sine}, eyes);
  // Facets count by what they are to a lane, whatever was met before and whichever other lanes there are
  const Floats floor = choose(lid <= from, lid, (1.0F / w.widened) * from);
  FacetSeen seen;
  visit_met(
      facets, wedge, [&] { return wedge.set_slopes(choose(left.unhidden.from < left.unhidden.to, floor, to), to); },
      [&](const OverhangFacets::Batch& batch, std::size_t lane) {
        if (!is_seen(batch, lane, eyes, w, floor, seen)) return;
        const CertainSlopes hidden = slopes_hidden(seen, w, floor);
        left.below = choose(max(hidden.at_most.low, lid) < min(hidden.at_most.high, from), broadcast(0.0F), left.below);
        left.open.hide(hidden.at_most);
        left.unhidden.hide(hidden.at_least);
      });
}

void find_certain(const FacetsInBoxes& facets, const WedgeShape& w, bool is_solid, float* room, WedgeGapBlock& gaps) {
  const GapEyes eyes(gaps.eyes);
  const Floats from = load(gaps.from.data()), to = load(gaps.to.data()), lid = load(gaps.lid.data()), zero = broadcast(0.0F);
  float* const more_room = room + 2 * lane_count * (lane_count * facets.batches.size() + 1);
  CertainGaps left{{from, to, room}, {min(lid, from), to, more_room}, load(gaps.below.data())};
  hide_facets(facets, w, gaps, eyes, left);
  const Outward outward = outward_of(gaps.eyes, eyes, w);
  const Floats upward = load(gaps.eyes.normal_z.data());
  const SkyOfGaps least(outward.least, upward, is_solid), most(outward.most, upward, is_solid);
  const Floats above_top = least.above(load(gaps.top.data())) - least.above(broadcast(beyond));
  store(w.angle * (open_of(left.open, least).sky + above_top) + left.below, gaps.open.data());
  // Above the ends that the gap has been narrowed to, all is hidden
  NarrowingGaps& unhidden = left.unhidden;
  const Floats reached = unhidden.hidden_from(unhidden.from),
               closed = max(reached - from, NarrowingGaps::joined(reached) - unhidden.to);
  unhidden.from = max(unhidden.from, from);
  const Floats hidden = w.angle * max(least.above(from) - least.above(to) - open_of(unhidden, least).sky, zero);
  store(hidden, gaps.hidden.data());
  const Floats left_of_all = max(w.angle * (most.above(from) - most.above(to)) - hidden, zero);
  const Mask is_closed = choose(lid <= from, closed, broadcast(-1.0F)) >= 0.0F;
  store(choose(is_closed, left_of_all, broadcast(beyond)), gaps.most.data());
}

}  // namespace

namespace FARLOD_TARGET {
extern const WedgeGapKernels wedge_gap_kernels;
constexpr WedgeGapKernels wedge_gap_kernels{find_certain};
}  // namespace FARLOD_TARGET

}  // namespace farlod
