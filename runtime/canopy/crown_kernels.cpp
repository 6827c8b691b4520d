// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/crown_kernels.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "canopy/canopy_lanes.hpp"
#include "canopy/crown_sections.hpp"
#include "horizon/edge_culling.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

static_assert(ReceiverPacket::lanes == lane_count && CrownBatches::lanes == lane_count);

// --- Which crowns are seen
// -------------------------------------------------------------------------------------------------------

template <class Sky>
FARLOD_LANES void find_ground_of(const SkyRows& rows, const CrownScene& scene, float* ground, float* lowest_ground) {
  const Normals normals = normals_of(*scene.receivers);
  for (std::size_t k = 0; k < scene.azimuths.size; ++k) {
    const Sky sky = sky_at<Sky>(normals, scene.azimuths.cosine[k], scene.azimuths.sine[k]);
    const SlopeInterval in_front = sky.in_front();
    Floats slope = min(max(load(rows.sky_from + k * lane_count), in_front.lowest), in_front.highest);
    // Where a gap has sky, what counts begins with it
    if (rows.gap_share != nullptr) {
      const SkyWindow gap = window_of_gap(rows, k, sky);
      slope = choose(gap.to > gap.from, min(gap.from, slope), slope);
    }
    store(slope, ground + k * lane_count);
    lowest_ground[k] = min_lane(slope);
  }
}

void find_ground(const SkyRows& rows, const CrownScene& scene, float* ground, float* lowest_ground) {
  if (scene.all_look_up) return find_ground_of<SkyStraightUp>(rows, scene, ground, lowest_ground);
  find_ground_of<SkyOfNormals>(rows, scene, ground, lowest_ground);
}

/// Sixteen crowns as seen from a packet: at which slopes and azimuths at most, with the margins of EdgeReach.
struct CrownReach {
  EdgeReach edge;
  Floats min_slope, distance;
};

/// The packet's box lies within `along` of its middle towards the axis, and `across` beside that way. The sine of the angle
/// between axis and crown is at most (across + a) / (distance − along): the sum of both angles has a sine of no more than that.
FARLOD_LANES CrownReach reach_of(const CrownBatches::Batch& b, const CenteredBox& box) {
  const Floats x = load(b.x.data()) - box.x, y = load(b.y.data()) - box.y, radius = load(b.plan_radius.data());
  const Floats distance = sqrt(x * x + y * y), inverse = 1.0F / max(distance, broadcast(min_clearance_m));
  const Floats along = (abs(x) * box.half_x + abs(y) * box.half_y) * inverse + min_clearance_m,
               across = (abs(y) * box.half_x + abs(x) * box.half_y) * inverse + min_clearance_m;
  // Azimuths
  const Floats clear = max(distance - along, broadcast(min_clearance_m)), sine = (across + radius) / clear;
  const Floats bounded_sine = min(sine, broadcast(1.0F)), cosine = sqrt(1.0F - bounded_sine * bounded_sine);
  const Floats from = pseudo_angle(x * cosine + y * bounded_sine, y * cosine - x * bounded_sine),
               to = pseudo_angle(x * cosine - y * bounded_sine, y * cosine + x * bounded_sine);
  // Slopes: the highest corner at the nearest place, the lowest one at the farthest
  const Floats rise = load(b.top.data()) - box.low_z, bottom = load(b.bottom.data()) - box.high_z;
  const Floats nearest = max(distance - along - radius, broadcast(min_clearance_m));
  const Mask is_close = choose(sine < 0.99F, distance - along - radius, broadcast(0.0F)) < 2.0F * min_clearance_m;
  CrownReach reach;
  reach.distance = distance;
  reach.edge.max_slope = choose(is_close, broadcast(EdgeReach::unbounded), rise / nearest * (1.0F + reach_margin) + reach_margin);
  reach.edge.max_slope = choose(rise > 0.0F, reach.edge.max_slope, broadcast(-1.0F));
  reach.min_slope = max(bottom / (distance + along + radius) * (1.0F - reach_margin) - reach_margin, broadcast(0.0F));
  reach.edge.from = from + (1.0F - reach_margin);
  reach.edge.to = from + within_half_a_turn(to - from) + (1.0F + reach_margin);
  return reach;
}

/// Appends a crown, unless it is between two azimuths.
FARLOD_LANES void add_seen(std::uint32_t crown, std::uint32_t first, std::uint32_t end, SeenCrown bounds, const AzimuthView& a,
                           SeenCrown*& next) {
  if (bounds.max_slope == EdgeReach::unbounded) {
    first = 0;
    end = a.size;
  }
  if (first == end) return;
  bounds.crown = crown;
  bounds.first = first < a.size ? first : first < 2 * a.size ? first - a.size : first - 2 * a.size;
  bounds.count = end - first < a.size ? end - first : a.size;
  *next++ = bounds;
}

std::size_t find_seen(const CrownScene& scene, const CenteredBox& box, const float* ground, SeenCrown* seen) {
  const AzimuthView& a = scene.azimuths;
  SectorMinHorizon lowest;
  find_sector_minima({&ground, 1}, a.first_of_sector, lowest);
  SeenCrown* next = seen;
  for (std::size_t n = 0; n < scene.batches.size(); ++n) {
    // Above the ground in their sectors, and some of them in range
    const CrownReach reach = reach_of(scene.batches[n], box);
    const Floats nearest = max(reach.distance - (box.half_x + box.half_y + min_clearance_m), broadcast(0.0F));
    std::uint32_t kept = scene.batches[n].used & raising_edges(reach.edge, lowest);
    kept &= ~bits_of(nearest * nearest > scene.range_square);
    if (kept == 0) continue;
    const std::array first_slot = to_array(truncate(reach.edge.from * a.slots)),
                     end_slot = to_array(truncate(reach.edge.to * a.slots) + 1);
    const std::array max_slope = to_array(reach.edge.max_slope), min_slope = to_array(reach.min_slope),
                     distance = to_array(reach.distance);
    for (; kept != 0; kept &= kept - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(kept));
      add_seen(static_cast<std::uint32_t>(n * lane_count + l), a.first_of_slot[first_slot[l]], a.first_of_slot[end_slot[l]],
               {0, 0, 0, min_slope[l], max_slope[l], distance[l]}, a, next);
    }
  }
  return static_cast<std::size_t>(next - seen);
}

// --- The union of what crowns cover
// ----------------------------------------------------------------------------------------------

/// An interval that is none: it begins above all slopes, and ends below.
constexpr float none_low = 1e30F, none_high = -1.0F;

/// Joins intervals with what is covered at an azimuth: with the ground or with the core where they touch it, else as one more of
/// the list. Which of these holds them changes no sum, which is taken over the whole union. Nothing depends on a branch that the
/// processor could not foresee.
struct Cover {
  const CoverRows& rows;

  /// Whether the bounds of a crown are below the ground or in the core of each receiver.
  FARLOD_LANES bool skips(const SeenCrown& seen, std::uint32_t k) const {
    const std::size_t row = std::size_t{k} * lane_count;
    const Floats ground = load(rows.ground + row), core_low = load(rows.core_low + row), core_high = load(rows.core_high + row);
    const Floats outside = max(core_low - seen.min_slope, seen.max_slope - core_high);
    return bits_of(min(outside, seen.max_slope - ground) > 0.0F) == 0;
  }

  FARLOD_LANES void visit(const SeenCrown&, std::uint32_t k, const CutCrown& cut) const {
    const std::size_t row = std::size_t{k} * lane_count;
    const Floats ground = load(rows.ground + row), core_low = load(rows.core_low + row), core_high = load(rows.core_high + row);
    // The ground rises to intervals that begin in it
    const Mask is_apart = cut.low > ground;
    store(max(ground, choose(is_apart, broadcast(none_high), cut.high)), rows.ground + row);
    // The core grows to intervals above it that touch the core, and begins with the first
    const Floats width = choose(is_apart, cut.high - cut.low, broadcast(-1.0F));
    const Mask is_empty = core_high < 0.0F;
    const Floats overlap = min(choose(is_empty, cut.high, core_high) - cut.low, cut.high - choose(is_empty, cut.low, core_low));
    const Mask joins = choose(width > 0.0F, overlap, broadcast(-1.0F)) >= 0.0F;
    store(choose(joins, min(core_low, cut.low), core_low), rows.core_low + row);
    store(choose(joins, max(core_high, cut.high), core_high), rows.core_high + row);
    // What is left is put at the end of the list, which is as long as before if nothing is. Lanes without it stay at the end
    const Mask is_left = choose(joins, broadcast(-1.0F), width) > 0.0F;
    const std::size_t place = (std::size_t{rows.begins[k]} + rows.counts[k]) * lane_count;
    store(choose(is_left, cut.low, broadcast(-none_low)), rows.low + place);
    store(choose(is_left, cut.high, broadcast(none_high)), rows.high + place);
    rows.counts[k] += bits_of(is_left) != 0 ? 1 : 0;
  }
};

void cover(const CrownScene& scene, std::span<const SeenCrown> seen, const CoverRows& covered) {
  const Eyes eyes = eyes_of(*scene.receivers);
  for (const SeenCrown& crown : seen) cut_crown(scene, crown, eyes, Cover{covered});
}

/// Puts the upper interval of two before the lower one, for each receiver.
FARLOD_LANES void order_two(float* low, float* high, std::size_t first, std::size_t second) {
  const Floats low_a = load(low + first * lane_count), low_b = load(low + second * lane_count);
  const Floats high_a = load(high + first * lane_count), high_b = load(high + second * lane_count);
  const Mask swaps = low_a < low_b;
  store(choose(swaps, low_b, low_a), low + first * lane_count);
  store(choose(swaps, high_b, high_a), high + first * lane_count);
  store(choose(swaps, low_a, low_b), low + second * lane_count);
  store(choose(swaps, high_a, high_b), high + second * lane_count);
}

/// Sorts the intervals of each receiver by their lower ends, from high to low: Batcher's merge exchange, whose steps depend on
/// the number of intervals alone.
FARLOD_LANES void sort_intervals(float* low, float* high, std::size_t count) {
  if (count < 2) return;
  const std::size_t largest = std::bit_ceil(count) / 2;
  for (std::size_t p = largest; p > 0; p /= 2) {
    std::size_t q = largest, r = 0;
    for (std::size_t apart = p; apart > 0; apart = q - p, q /= 2, r = p) {
      for (std::size_t n = 0; n + apart < count; ++n)
        if ((n & p) == r) order_two(low, high, n, n + apart);
    }
  }
}

/// The sky of the union of what is covered at an azimuth, from the maximal intervals that make it up.
template <class Sky>
FARLOD_LANES Floats covered_sky(const CoverRows& c, std::size_t k, const Sky& sky, const SkyWindow& above, const SkyWindow* gap) {
  const float *low = c.low + std::size_t{c.begins[k]} * lane_count, *high = c.high + std::size_t{c.begins[k]} * lane_count;
  const std::size_t count = c.counts[k];
  // A run of intervals that touch each other, from the ground on
  Floats from = broadcast(-1.0F), to = load(c.ground + k * lane_count), sum{};
  for (std::size_t n = count + 1; n-- > 0;) {
    // Beyond the last, the run ends in all lanes
    const Floats next_low = n > 0 ? load(low + (n - 1) * lane_count) : broadcast(none_low);
    const Mask opens = next_low > to;
    if (bits_of(opens) != 0) {
      // The run ends in some lanes: add its sky there
      Floats term = sky_within(above, sky, from, to);
      if (gap != nullptr) term += sky_within(*gap, sky, from, to);
      sum += choose(opens, term, broadcast(0.0F));
      from = choose(opens, next_low, from);
    }
    if (n > 0) to = max(choose(opens, load(high + (n - 1) * lane_count), to), load(high + (n - 1) * lane_count));
  }
  return sum;
}

template <class Sky>
FARLOD_LANES void sum_covered_of(const SkyRows& rows, const CrownScene& scene, const CoverRows& c, float* sum) {
  const Normals normals = normals_of(*scene.receivers);
  Sum total(c.behind);
  for (std::size_t k = 0; k < scene.azimuths.size; ++k) {
    const Sky sky = sky_at<Sky>(normals, scene.azimuths.cosine[k], scene.azimuths.sine[k]);
    const SkyWindow above = window_above(rows, k, sky);
    if (rows.gap_share == nullptr) {
      total.add(covered_sky(c, k, sky, above, nullptr));
      continue;
    }
    const SkyWindow gap = window_of_gap(rows, k, sky);
    total.add(covered_sky(c, k, sky, above, &gap));
  }
  store(total.total() / static_cast<float>(scene.azimuths.size), sum);
}

void sum_covered(const SkyRows& rows, const CrownScene& scene, const CoverRows& c, float* sum) {
  // The core is the first interval of the list
  for (std::uint32_t k = 0; k < scene.azimuths.size; ++k) {
    float *const low = c.low + std::size_t{c.begins[k]} * lane_count, *const high =
                                                                          c.high + std::size_t{c.begins[k]} * lane_count;
    store(load(c.core_low + std::size_t{k} * lane_count), low);
    store(load(c.core_high + std::size_t{k} * lane_count), high);
    sort_intervals(low, high, c.counts[k]);
  }
  if (scene.all_look_up) return sum_covered_of<SkyStraightUp>(rows, scene, c, sum);
  sum_covered_of<SkyOfNormals>(rows, scene, c, sum);
}

}  // namespace

namespace FARLOD_TARGET {
extern const CrownKernels crown_kernels;
constexpr CrownKernels crown_kernels{
    .find_ground = find_ground, .find_seen = find_seen, .cover = cover, .sum_covered = sum_covered};
}  // namespace FARLOD_TARGET

}  // namespace farlod
