// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "horizon/edge_crossing.hpp"
#include "horizon/edge_culling.hpp"
#include "horizon/lanes.hpp"
#include "horizon/wedge_kernels.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

// --- Ends in wedges
// ---------------------------------------------------------------------------------------------------------------

struct Eyes {
  Floats x, y, z;
};

/// At most how steep, and between which slots of azimuths, does some receiver see each of sixteen places? As EdgeReach.
FARLOD_LANES EdgeReach reach_of_ends(const EndBatch& ends, const CenteredBox& box, float slots) {
  const Floats px = load(ends.x) - box.x, py = load(ends.y) - box.y;
  const Floats rise = max(load(ends.z) - box.low_z, broadcast(0.0F));
  const Floats away_x = max(abs(px) - box.half_x, broadcast(0.0F)), away_y = max(abs(py) - box.half_y, broadcast(0.0F));
  const Floats distance = sqrt(away_x * away_x + away_y * away_y);
  EdgeReach reach;
  reach.max_slope = choose(distance > min_clearance_m, (1.0F + reach_margin) * rise / max(distance, broadcast(min_clearance_m)),
                           broadcast(EdgeReach::unbounded));
  const AzimuthInterval a = azimuths_from_rectangle(px, py, box.half_x, box.half_y);
  reach.from = (a.from + (1.0F - reach_margin)) * slots;
  reach.to = (a.from + within_half_a_turn(a.to - a.from) + (1.0F + reach_margin)) * slots;
  return reach;
}

/// A slope that an end is not steeper than, whatever rounding says.
FARLOD_LANES Floats slope_of_end(const Floats& rise, const Floats& square) {
  return (1.00001F * rise) / sqrt(max(square, broadcast(1e-12F)));
}

/// Raises the tops of some wedges in a row to an end, in the wedge between d and e where each receiver sees it: d × p ≥ 0 and
/// p × e ≥ 0, with a margin. A wedge opposite counts, too, where it is among these: more, never less.
FARLOD_LANES void raise_few(const Floats& x, const Floats& y, const Floats& rise, const AzimuthView& a, std::uint32_t first,
                            std::uint32_t count, float* tops) {
  const Floats slope = slope_of_end(rise, x * x + y * y), margin = -1e-6F * (abs(x) + abs(y));
  const auto to_left_of = [&](std::uint32_t k) { return a.cosine[k] * y - a.sine[k] * x; };
  Floats before = to_left_of(first);
  for (std::uint32_t n = 0, wedge = first; n < count; ++n) {
    const std::uint32_t next = wedge + 1 < a.size ? wedge + 1 : 0;
    const Floats after = to_left_of(next);
    // Whether it is above a horizon or not: a branch would cost more
    float* top = tops + std::size_t{wedge} * lane_count;
    store(max(load(top), choose(min(before, -after) >= margin, slope, broadcast(0.0F))), top);
    before = after;
    wedge = next;
  }
}

/// The azimuth in wedges from the first azimuth on, from 0.
FARLOD_LANES Floats wedges_to(const Floats& x, const Floats& y, const AzimuthView& a) {
  const float cosine = a.cosine[0], sine = a.sine[0];
  const Floats along = x * cosine + y * sine, left = y * cosine - x * sine;
  const Floats ax = abs(along), ay = abs(left), most = max(max(ax, ay), broadcast(1e-12F));
  constexpr float quarter = 1.57079632679F;
  const Floats octant = atan_of_fraction(min(ax, ay) / most);
  const Floats first = choose(ay > ax, quarter - octant, octant);
  const Floats half = choose(along < 0.0F, 2.0F * quarter - first, first);
  const Floats angle = choose(left < 0.0F, 4.0F * quarter - half, half);
  return angle * (static_cast<float>(a.size) / (4.0F * quarter));
}

FARLOD_LANES void raise_top(float slope, float& top) { top = top > slope ? top : slope; }

/// Raises the tops of the receivers with set bits to a slope, in a wedge of each, and where that is `at_border` beside it, too.
FARLOD_LANES void raise_lanes(std::uint32_t raised, std::uint32_t at_border, const std::array<float, lane_count>& slopes,
                              const std::array<std::int32_t, lane_count>& wedges, std::uint32_t turn, float* tops) {
  for (; raised != 0; raised &= raised - 1) {
    const auto l = static_cast<std::size_t>(__builtin_ctz(raised));
    const auto k = static_cast<std::uint32_t>(wedges[l]);
    raise_top(slopes[l], tops[std::size_t{k} * lane_count + l]);
    if (((at_border >> l) & 1U) == 0) continue;
    for (const std::uint32_t beside : {k + 1, k + turn - 1})
      raise_top(slopes[l], tops[std::size_t{within_turn(beside, turn)} * lane_count + l]);
  }
}

/// The same, receiver by receiver: an end that is near lies in another wedge for each.
FARLOD_LANES void raise_many(const Floats& x, const Floats& y, const Floats& rise, const AzimuthView& a, const float* lower,
                             float* tops) {
  const Floats square = x * x + y * y;
  // slope > horizon by squares, which take no root; more than rounding takes in favour of the end
  constexpr float favour = 1.00002F;
  const Floats rise_square = favour * rise * rise;
  const Floats place = wedges_to(x, y, a);
  const Ints wedge = truncate(place), known = choose(wedge < broadcast(static_cast<std::int32_t>(a.size)), wedge, broadcast(0));
  const std::array wedges = to_array(known);
  std::array<float, lane_count> below;
  for (std::size_t l = 0; l < lane_count; ++l) below[l] = lower[static_cast<std::size_t>(wedges[l]) * lane_count + l];
  // Near a border rounding may take the wrong wedge: both count, whatever is above
  const float margin = 2e-3F + 1e-6F * static_cast<float>(a.size);
  const Floats inside = place - to_floats(wedge), from_border = min(inside - margin, (1.0F - margin) - inside);
  const std::uint32_t at_border = bits_of(choose(from_border < 0.0F, rise, broadcast(0.0F)) > 0.0F);
  const Floats horizon = load(below.data());
  std::uint32_t raised = bits_of(rise_square > horizon * horizon * square) | at_border;
  if (raised == 0) return;
  raise_lanes(raised, at_border, to_array(slope_of_end(rise, square)), wedges, a.size, tops);
}

/// The least of so many wedges in a row, of LowerHorizons::minima: that of two runs.
FARLOD_LANES float least_of_run(const float* minima, std::uint32_t turn, std::uint32_t first, std::uint32_t count) {
  const std::uint32_t level = 31U - static_cast<std::uint32_t>(__builtin_clz(count));
  const float* of_level = minima + std::size_t{level} * turn;
  return std::min(of_level[first], of_level[within_turn(first + count - (1U << level), turn)]);
}

FARLOD_LANES void raise_tops_of(const EndBatch& ends, const CenteredBox& box, const Eyes& eyes, const AzimuthView& a,
                                const LowerHorizons& lower, float* tops) {
  const EdgeReach reach = reach_of_ends(ends, box, a.slots);
  const std::array slopes = to_array(reach.max_slope);
  const std::array from = to_array(truncate(reach.from)), to = to_array(truncate(reach.to) + 1);
  for (std::uint32_t kept = seen_edges(reach); kept != 0; kept &= kept - 1) {
    const auto m = static_cast<std::size_t>(__builtin_ctz(kept));
    const Floats x = ends.x[m] - eyes.x, y = ends.y[m] - eyes.y, rise = max(ends.z[m] - eyes.z, broadcast(0.0F));
    if (slopes[m] == EdgeReach::unbounded) {
      raise_many(x, y, rise, a, lower.rows, tops);
      continue;
    }
    // The wedges from that of the first azimuth on
    const std::uint32_t begin = a.first_of_slot[from[m]] - 1, count = a.first_of_slot[to[m]] - begin;
    const std::uint32_t first = within_turn(begin, a.size);
    if (!(slopes[m] > least_of_run(lower.minima, a.size, first, count))) continue;
    // Faster than each receiver's own wedge
    constexpr std::uint32_t few = 10;
    if (count <= few)
      raise_few(x, y, rise, a, first, count, tops);
    else
      raise_many(x, y, rise, a, lower.rows, tops);
  }
}

void raise_tops(std::span<const EndBatch> ends, const ReceiverPacket& r, const CenteredBox& box, const AzimuthView& a,
                const LowerHorizons& lower, float* tops) {
  const Eyes eyes{load(r.x.data()), load(r.y.data()), load(r.z.data())};
  for (const EndBatch& batch : ends) raise_tops_of(batch, box, eyes, a, lower, tops);
}

/// The least of two neighboring runs of wedges, each `apart` long, from each wedge on.
FARLOD_LANES void find_least_of_two(const float* half, std::size_t wedges, std::size_t apart, float* whole) {
  for (std::size_t k = 0; k < wedges - apart; ++k) whole[k] = std::min(half[k], half[k + apart]);
  for (std::size_t k = wedges - apart; k < wedges; ++k) whole[k] = std::min(half[k], half[k + apart - wedges]);
}

void find_lower(const float* slopes, std::size_t azimuths, const LowerHorizons& lower) {
  for (std::size_t k = 0; k < azimuths; ++k) {
    const std::size_t next = k + 1 < azimuths ? k + 1 : 0;
    const Floats least = min(load(slopes + k * lane_count), load(slopes + next * lane_count));
    store(least, lower.rows + k * lane_count);
    lower.minima[k] = min_lane(least);
  }
  float* minima = lower.minima;
  for (std::size_t apart = 1; 2 * apart <= azimuths; apart *= 2, minima += azimuths)
    find_least_of_two(minima, azimuths, apart, minima + azimuths);
}

// --- Edges in wedges
// --------------------------------------------------------------------------------------------------------------

std::size_t keep_rising(const EdgeSpans& s, std::size_t edges, const float* minima, std::uint32_t turn,
                        const RoomForSpans& kept) {
  std::size_t count = 0;
  for (std::size_t n = 0; n < edges; ++n) {
    // Without a branch: one that is not kept is written over
    kept.number[count] = s.number[n];
    kept.first[count] = s.first[n];
    kept.count[count] = s.count[n];
    kept.max_slope[count] = s.max_slope[n];
    const float least =
        least_of_run(minima, turn, static_cast<std::uint32_t>(s.first[n]), static_cast<std::uint32_t>(s.count[n]));
    count += s.max_slope[n] > least ? 1 : 0;
  }
  return count;
}

/// The spans of sixteen edges from one on that reach into a wedge and may be steeper than a slope: a bit for each.
FARLOD_LANES std::uint32_t reaching_spans(const EdgeSpans& s, std::size_t first, std::int32_t wedge, std::int32_t wedges,
                                          float slope) {
  const Ints behind = wedge - load(s.first + first), ahead = choose(behind < 0, behind + wedges, behind);
  return bits_of(ahead < load(s.count + first)) & bits_of(load(s.max_slope + first) > slope);
}

std::size_t list_reaching(const EdgeSpans& s, std::size_t edges, std::uint32_t wedge, std::uint32_t wedges, float slope,
                          std::uint32_t* numbers) {
  std::size_t count = 0;
  for (std::size_t first = 0; first < edges; first += lane_count)
    for (std::uint32_t bits =
             reaching_spans(s, first, static_cast<std::int32_t>(wedge), static_cast<std::int32_t>(wedges), slope);
         bits != 0; bits &= bits - 1)
      numbers[count++] = s.number[first + static_cast<std::uint32_t>(__builtin_ctz(bits))];
  return count;
}

/// The slopes of sixteen edges along a direction; 0 where it passes them, or they are seen end-on.
FARLOD_LANES Floats slopes_along(const WedgeEdges& edges, const LookInWedge& look) {
  RelativeEdge e;
  e.px = load(edges.ax) - look.x;
  e.py = load(edges.ay) - look.y;
  e.pz = load(edges.az) - look.z;
  e.qx = load(edges.bx) - look.x;
  e.qy = load(edges.by) - look.y;
  e.qz = load(edges.bz) - look.z;
  const Floats cross = e.px * e.qy - e.py * e.qx;
  e.inverse_cross = choose(off_line_of(e, cross) > 0.0F, 1.0F / cross, broadcast(0.0F));
  const Crossing c = crossing_of(e, EdgeReach::unbounded, look.cosine, look.sine);
  return choose(c.inside >= 0.0F, c.slope, broadcast(0.0F));
}

/// The highest edge of each lane, of two at the same slope the one with the lower number.
struct HighestOfLanes {
  Floats slope;
  Ints number;

  FARLOD_LANES void take(const Floats& other, const Ints& number_of_other) {
    const Ints lower = choose(other == slope, min(number_of_other, number), number);
    number = choose(other > slope, number_of_other, lower);
    slope = max(other, slope);
  }
  [[nodiscard]] FARLOD_LANES HighestBorder of_all() const {
    const float highest = max_lane(slope);
    const std::array numbers = to_array(number);
    std::int32_t lowest_number = std::numeric_limits<std::int32_t>::max();
    for (std::uint32_t bits = bits_of(slope == highest); bits != 0; bits &= bits - 1)
      lowest_number = std::min(lowest_number, numbers[static_cast<std::size_t>(__builtin_ctz(bits))]);
    return {highest, lowest_number};
  }
};

HighestBorder find_highest(const EdgeSpans& s, std::size_t edges, std::span<const BorderEnds::End> ends,
                           const LookInWedge& look) {
  HighestOfLanes highest{broadcast(look.above), broadcast(-1)};
  WedgeEdges some{};
  std::int32_t numbers[lane_count]{};
  std::size_t count = 0;
  for (std::size_t first = 0; first < edges; first += lane_count)
    for (std::uint32_t bits =
             reaching_spans(s, first, static_cast<std::int32_t>(look.wedge), static_cast<std::int32_t>(look.wedges), look.above);
         bits != 0; bits &= bits - 1) {
      const std::uint32_t number = s.number[first + static_cast<std::uint32_t>(__builtin_ctz(bits))];
      some.put(count, ends[2 * std::size_t{number}].p, ends[2 * std::size_t{number} + 1].p);
      numbers[count++] = static_cast<std::int32_t>(number);
      if (count < lane_count) continue;
      highest.take(slopes_along(some, look), load(numbers));
      count = 0;
    }
  // Lanes of those that were before are no harm
  highest.take(slopes_along(some, look), load(numbers));
  return highest.of_all();
}

FARLOD_LANES void mark_steeper(float slope, const float* least, std::size_t first, std::size_t end, std::uint8_t* wedges) {
  for (std::size_t k = first; k < end; ++k) wedges[k] |= static_cast<std::uint8_t>(slope > least[k]);
}

void mark_reached(const EdgeSpans& s, std::size_t edges, const float* minima, std::uint32_t turn, std::uint8_t* wedges) {
  for (std::size_t n = 0; n < edges; ++n) {
    const auto first = static_cast<std::uint32_t>(s.first[n]), end = first + static_cast<std::uint32_t>(s.count[n]);
    mark_steeper(s.max_slope[n], minima, first, std::min(end, turn), wedges);
    if (end > turn) mark_steeper(s.max_slope[n], minima, 0, end - turn, wedges);
  }
}

}  // namespace

namespace FARLOD_TARGET {
extern const WedgeEndKernels wedge_end_kernels;
constexpr WedgeEndKernels wedge_end_kernels{find_lower, raise_tops, keep_rising, list_reaching, find_highest, mark_reached};
}  // namespace FARLOD_TARGET

}  // namespace farlod
