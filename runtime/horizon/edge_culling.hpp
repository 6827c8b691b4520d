// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/lanes.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "package/horizon_edge.hpp"

/// Which edges of a batch can change a horizon of a packet: three conservative tests, each for sixteen edges at once.
///   1. facing: can the edge be a silhouette for some receiver of the box? docs/concepts.md, "Edges that face away"
///   2. reach: at most how steep, and between which azimuths, does some receiver see it?
///   3. culling: is that above the lowest horizon in those azimuths? docs/concepts.md, "Culling edges for a packet"
namespace farlod {

// --- 1. Facing
// -------------------------------------------------------------------------------------------------------------------

inline constexpr auto facing_margin_m = static_cast<float>(facing_slack_m);
/// Relative to the coordinates in a sum: more than the rounding of all its operations, 16 · 2⁻²⁴.
inline constexpr float facing_rounding = 0x1p-20F;

/// The terms of may_be_silhouette (package/horizon_edge.hpp), all multiplied by the edge's run (horizontal length), which
/// saves divisions. c is the centre of the receivers' box, relative to the edge's end a; e = b − a.
struct FacingTerms {
  Floats center_x, center_y;              ///< c
  Floats a_z, along_x, along_y, along_z;  ///< a_z, e
  Floats run, cosine, sine;               ///< |e_xy|; of the edge's inclination
  Floats ahead, left;                     ///< e · c and e × c in the plan
  Floats margin;                          ///< slack and rounding
};

/// Sixteen edges for one box of receivers, or one edge for sixteen receivers.
struct FacedEdges {
  Floats ax, ay, az, bx, by, bz, left, right;  ///< as those of a SilhouetteEdges::Batch
};
struct FacingBoxes {
  Floats x, y;  ///< as those of a CenteredBox
  float half_x, half_y;
  Floats low_z, high_z;
};
FARLOD_LANES FacedEdges faced_edges(const SilhouetteEdges::Batch& e) {
  return {load(e.ax.data()), load(e.ay.data()), load(e.az.data()),   load(e.bx.data()),
          load(e.by.data()), load(e.bz.data()), load(e.left.data()), load(e.right.data())};
}
FARLOD_LANES FacedEdges faced_edge(const SilhouetteEdges::Batch& e, std::size_t lane) {
  return {broadcast(e.ax[lane]), broadcast(e.ay[lane]), broadcast(e.az[lane]),   broadcast(e.bx[lane]),
          broadcast(e.by[lane]), broadcast(e.bz[lane]), broadcast(e.left[lane]), broadcast(e.right[lane])};
}
FARLOD_LANES FacingBoxes facing_boxes(const CenteredBox& b) {
  return {broadcast(b.x), broadcast(b.y), b.half_x, b.half_y, broadcast(b.low_z), broadcast(b.high_z)};
}
/// Each receiver is a box of its own.
FARLOD_LANES FacingBoxes facing_boxes(const Floats& x, const Floats& y, const Floats& z) { return {x, y, 0.0F, 0.0F, z, z}; }

FARLOD_LANES FacingTerms facing_terms(const FacedEdges& e, const FacingBoxes& box) {
  FacingTerms t;
  // e = b − a and c, in the plan
  t.a_z = e.az;
  t.along_x = e.bx - e.ax;
  t.along_y = e.by - e.ay;
  t.along_z = e.bz - e.az;
  t.center_x = box.x - e.ax;
  t.center_y = box.y - e.ay;
  // The inclination of the edge: cosine = run / length, sine = e_z / length
  const Floats run_square = t.along_x * t.along_x + t.along_y * t.along_y;
  t.run = sqrt(run_square);
  const Floats length = max(sqrt(run_square + t.along_z * t.along_z), broadcast(1e-12F));
  t.cosine = t.run / length;
  t.sine = t.along_z / length;
  // The centre's coordinates along the edge and to its left, times run
  t.ahead = t.along_x * t.center_x + t.along_y * t.center_y;
  t.left = t.along_x * t.center_y - t.along_y * t.center_x;
  // The margin grows with the coordinates that are added up below
  const Floats coordinates = abs(t.center_x) + abs(t.center_y) + (box.half_x + box.half_y) + abs(box.low_z - t.a_z) +
                             abs(box.high_z - t.a_z) + abs(t.along_z);
  t.margin = t.run * (facing_margin_m + facing_rounding * coordinates);
  return t;
}

/// An interval that holds  sign · rise(z) − slope · |aside|, times run, of all receivers of a box: rise is the height over the
/// edge's line, at right angles to it, of a receiver at the height z; slope that of a facet beside the edge. All receivers are on
/// one side of the edge.
struct Excess {
  Floats middle, spread;
  [[nodiscard]] FARLOD_LANES Floats most() const { return middle + spread; }
  [[nodiscard]] FARLOD_LANES Floats least() const { return middle - spread; }
};
FARLOD_LANES Excess excess_of(const FacingTerms& t, const FacingBoxes& box, float sign, const Floats& z, const Floats& slope) {
  // At the centre: rise = (z − a_z) run cosine − ahead sine
  const Floats rise = (z - t.a_z) * t.run * t.cosine - t.ahead * t.sine;
  // The excess is linear in x and y: half a side times its gradient is the most that it grows towards a corner
  const Floats slope_to_left = choose(t.left > 0.0F, slope, -slope), sine = sign * t.sine;
  const Floats per_x = slope_to_left * t.along_y - sine * t.along_x, per_y = -slope_to_left * t.along_x - sine * t.along_y;
  return {sign * rise - t.left * slope_to_left,
          abs(per_x) * box.half_x + abs(per_y) * box.half_y + t.margin * (1.0F + abs(slope))};
}

/// A receiver above the edge does not have it as a horizon: heights end below its higher end.
FARLOD_LANES Floats below_edge(const FacingTerms& t) { return t.a_z + max(t.along_z, broadcast(0.0F)) - 2.0F * facing_margin_m; }
/// Greater than 0 where all receivers are on one side of the edge. An upright edge has no sides.
FARLOD_LANES Floats clear_aside(const FacingTerms& t, const FacingBoxes& box) {
  return abs(t.left) - abs(t.along_y) * box.half_x - abs(t.along_x) * box.half_y - t.margin;
}
/// The slopes of the facets towards and away from the receivers.
FARLOD_LANES Floats near_slope(const FacingTerms& t, const FacedEdges& e) { return choose(t.left > 0.0F, e.left, e.right); }
FARLOD_LANES Floats far_slope(const FacingTerms& t, const FacedEdges& e) { return choose(t.left > 0.0F, e.right, e.left); }

/// Greater than 0 for the edges that may be a silhouette for some receiver of a box. A lower border is an upper one upside down.
FARLOD_LANES Floats may_be_silhouette(const FacingTerms& t, const FacedEdges& e, const FacingBoxes& box, bool is_upper) {
  const Floats highest = min(box.high_z, below_edge(t)), lowest = box.low_z;
  // Some receiver sees the edge over the near facet, and some receiver sees no far facet rise behind it
  const Floats over_near = is_upper ? excess_of(t, box, 1.0F, highest, near_slope(t, e)).most()
                                    : excess_of(t, box, -1.0F, lowest, -near_slope(t, e)).most();
  const Floats over_far = is_upper ? excess_of(t, box, -1.0F, lowest, far_slope(t, e)).most()
                                   : excess_of(t, box, 1.0F, highest, -far_slope(t, e)).most();
  // With receivers on both sides there is no near and far: keep the edge
  return choose(clear_aside(t, box) > 0.0F, min(over_near, over_far), broadcast(1.0F));
}

/// Greater than 0 for the lower borders that certainly face all receivers of a box.
FARLOD_LANES Floats face_all(const FacingTerms& t, const FacedEdges& e, const FacingBoxes& box) {
  const Floats over_near = excess_of(t, box, -1.0F, box.high_z, -near_slope(t, e)).least(),
               over_far = excess_of(t, box, 1.0F, min(box.low_z, below_edge(t)), -far_slope(t, e)).least();
  return min(clear_aside(t, box), min(over_near, over_far));
}

/// A bit for each edge of a batch: whether it may face some receiver of a box; and of lower borders, whether it may not face all.
struct FacingEdges {
  std::uint32_t some = 0, doubtful = 0;
};
FARLOD_LANES FacingEdges facing_edges(const SilhouetteEdges::Batch& edges, const CenteredBox& box, bool is_upper) {
  const FacedEdges faced = faced_edges(edges);
  const FacingBoxes boxes = facing_boxes(box);
  const FacingTerms terms = facing_terms(faced, boxes);
  FacingEdges facing{bits_of(may_be_silhouette(terms, faced, boxes, is_upper) > 0.0F)};
  if (!is_upper) facing.doubtful = ~bits_of(face_all(terms, faced, boxes) > 0.0F);
  return facing;
}

/// Distance in the plan from the box's centre to the edge: |c − s e| with s = clamp(e · c / |e|², 0, 1).
FARLOD_LANES Floats distance_from_center(const FacingTerms& t) {
  const Floats square = t.run * t.run, share = t.ahead / choose(square > 0.0F, square, broadcast(1.0F));
  const Floats s = min(max(share, broadcast(0.0F)), broadcast(1.0F));
  const Floats x = t.center_x - s * t.along_x, y = t.center_y - s * t.along_y;
  return sqrt(x * x + y * y);
}

// --- 2. Reach
// --------------------------------------------------------------------------------------------------------------------

/// Upper bounds of the slopes at which some receiver of a packet sees each edge, and intervals of azimuths that hold the edge for
/// all of them. An edge that no receiver can see has the bound −1; an edge that is too close for a bound has `unbounded`, and its
/// interval means nothing. Azimuths are pseudo_angle in turns, from 0 to 3, so that an interval never wraps.
struct EdgeReach {
  static constexpr float unbounded = std::numeric_limits<float>::infinity();
  Floats max_slope, from, to;
};

/// Bounds are widened by this share, and intervals by so many turns: many times the rounding of floats.
inline constexpr float reach_margin = 1e-4F;
/// An edge closer to the box than this, or crossing it, is unbounded: many times the rounding of floats, too.
inline constexpr float min_clearance_m = 0.01F;

/// The representative in [−1/2, 1/2] of a difference of two azimuths in turns.
FARLOD_LANES Floats within_half_a_turn(const Floats& turns) {
  return choose(turns > 0.5F, turns - 1.0F, choose(turns < -0.5F, turns + 1.0F, turns));
}

FARLOD_LANES std::uint32_t within_turn(std::uint32_t k, std::uint32_t turn) {
  return k >= 2 * turn ? k - 2 * turn : k >= turn ? k - turn : k;
}

struct AzimuthInterval {
  Floats from, to;
};
/// The azimuths at which some place of a rectangle around the origin sees the point (x, y) outside it. The extremes are the
/// azimuths from two corners. If the point lies beyond both sides that meet in the nearest corner, they are the corners left and
/// right of that one; else they are the ends of the side that the point lies in front of.
FARLOD_LANES AzimuthInterval azimuths_from_rectangle(const Floats& x, const Floats& y, float half_x, float half_y) {
  const Floats x_towards_x = choose(x < 0.0F, broadcast(-half_x), broadcast(half_x)),
               x_towards_y = choose(y < 0.0F, broadcast(-half_x), broadcast(half_x));
  const Floats y_towards_x = choose(x < 0.0F, broadcast(-half_y), broadcast(half_y)),
               y_towards_y = choose(y < 0.0F, broadcast(-half_y), broadcast(half_y));
  const Floats beyond_x = abs(x) - half_x, beyond_y = abs(y) - half_y;
  const Floats from_x = choose(beyond_y > 0.0F, -x_towards_y, x_towards_x),
               from_y = choose(beyond_x > 0.0F, y_towards_x, y_towards_y);
  const Floats to_x = choose(beyond_y > 0.0F, x_towards_y, x_towards_x),
               to_y = choose(beyond_x > 0.0F, -y_towards_x, y_towards_y);
  return {pseudo_angle(x - from_x, y - from_y), pseudo_angle(x - to_x, y - to_y)};
}

/// The ends of edges in the plan, relative to the centre of the box: p = a − c, q = b − c.
struct EdgesFromCenter {
  Floats px, py, qx, qy;
};

/// An upper bound of the slope of edges `rise` above the box's floor: rise / clearance, where the nearest point of the edge is
/// n d from the centre and the clearance is d − |n_x| half_x − |n_y| half_y.
FARLOD_LANES Floats slope_bound(const EdgesFromCenter& e, const Floats& rise, const CenteredBox& box) {
  // Nearest point: p + s (q − p), s = clamp(−p · (q − p) / |q − p|², 0, 1)
  const Floats along_x = e.qx - e.px, along_y = e.qy - e.py, along_square = along_x * along_x + along_y * along_y;
  const Floats share = -(e.px * along_x + e.py * along_y) / choose(along_square > 0.0F, along_square, broadcast(1.0F));
  const Floats s = min(max(share, broadcast(0.0F)), broadcast(1.0F));
  const Floats nearest_x = e.px + s * along_x, nearest_y = e.py + s * along_y;
  const Floats square = nearest_x * nearest_x + nearest_y * nearest_y, distance = sqrt(square);
  // Both times the distance, which saves the division by it: the clearance, and the least clearance that is enough
  const Floats clearance = square - abs(nearest_x) * box.half_x - abs(nearest_y) * box.half_y;
  const Floats enough = min_clearance_m * distance;
  const Floats bound =
      rise * distance / max(clearance, broadcast(min_clearance_m * min_clearance_m)) * (1.0F + reach_margin) + reach_margin;
  return choose(clearance > enough, bound, broadcast(EdgeReach::unbounded));
}

FARLOD_LANES EdgeReach reach_of(const SilhouetteEdges::Batch& edges, const PacketBounds& packet) {
  const CenteredBox& box = packet.box;
  const Floats ax = load(edges.ax.data()), ay = load(edges.ay.data()), az = load(edges.az.data());
  const Floats bx = load(edges.bx.data()), by = load(edges.by.data()), bz = load(edges.bz.data());
  const EdgesFromCenter e{ax - box.x, ay - box.y, bx - box.x, by - box.y};
  // Slopes: an edge below the lowest receiver, or with both ends behind the packet's plane, is seen by none
  const Floats rise = max(az, bz) - box.low_z;
  const Floats in_front = max(packet.normal_x * ax + packet.normal_y * ay + packet.normal_z * az,
                              packet.normal_x * bx + packet.normal_y * by + packet.normal_z * bz) -
                          packet.depth;
  EdgeReach reach;
  const Floats bound = slope_bound(e, rise, box);
  reach.max_slope = choose(min(rise, in_front) > 0.0F, bound, broadcast(-1.0F));
  // Azimuths: the hull of those of both ends. A line separates box and edge, so all lie within half a turn of each other
  const AzimuthInterval a = azimuths_from_rectangle(e.px, e.py, box.half_x, box.half_y),
                        b = azimuths_from_rectangle(e.qx, e.qy, box.half_x, box.half_y);
  const Floats a_to = a.from + within_half_a_turn(a.to - a.from);
  const Floats b_from = a.from + within_half_a_turn(b.from - a.from), b_to = a.from + within_half_a_turn(b.to - a.from);
  // Plus one turn, so that azimuths are positive and truncation rounds down
  reach.from = min(a.from, b_from) + (1.0F - reach_margin);
  reach.to = max(a_to, b_to) + (1.0F + reach_margin);
  return reach;
}

// --- 3. Culling
// ------------------------------------------------------------------------------------------------------------------

/// A sparse table of range minima: minima[level * sectors + s] is the lowest slope of any receiver's horizon in the 2^level
/// sectors from s on, past the end of the turn. The minimum over any run of sectors is that of two entries.
struct SectorMinHorizon {
  static constexpr std::size_t sectors = AzimuthSampling::sectors, levels = std::bit_width(sectors);
  static_assert(std::has_single_bit(sectors));
  std::array<float, levels * sectors> minima;
};

/// Fills the levels above level 0: level n holds the minima of two neighboring runs of half the length.
FARLOD_LANES void find_levels(SectorMinHorizon& horizon) {
  constexpr std::size_t sectors = SectorMinHorizon::sectors;
  // data() could be emitted on its own, for one target in the place of all. NOLINTNEXTLINE(readability-container-data-pointer)
  float* const minima = &horizon.minima[0];
  for (std::size_t level = 1; level < SectorMinHorizon::levels; ++level) {
    const std::size_t apart = std::size_t{1} << (level - 1);
    const float* half = minima + (level - 1) * sectors;
    float* whole = minima + level * sectors;
    for (std::size_t s = 0; s < sectors - apart; ++s) whole[s] = std::min(half[s], half[s + apart]);
    for (std::size_t s = sectors - apart; s < sectors; ++s) whole[s] = std::min(half[s], half[s + apart - sectors]);
  }
}

/// The azimuths that a sector's minimum is taken of: those in it, and for what lies between the azimuths the two beside it, too.
enum class SectorAzimuths : std::uint8_t { inside, and_beside };

/// The minima of one packet or several, each slopes[azimuth][receiver]. A sector without azimuths has no horizon that an edge
/// could raise: its minimum is the largest float.
FARLOD_LANES void find_sector_minima(std::span<const float* const> packets, const AzimuthView& azimuths, SectorAzimuths taken,
                                     SectorMinHorizon& horizon) {
  constexpr std::size_t sectors = SectorMinHorizon::sectors;
  // As above. NOLINTNEXTLINE(readability-container-data-pointer)
  float* const minima = &horizon.minima[0];
  // Level 0: the minimum over the azimuths of a sector and over the packets, then over the lanes
  for (std::size_t first = 0; first < sectors; first += lane_count) {
    Floats lowest[lane_count];
    for (std::size_t n = 0; n < lane_count; ++n) {
      lowest[n] = broadcast(std::numeric_limits<float>::max());
      const std::size_t begin = azimuths.first_of_sector[first + n], end = azimuths.first_of_sector[first + n + 1];
      const std::size_t before = (begin == 0 ? azimuths.size : begin) - 1, after = end == azimuths.size ? 0 : end;
      for (const float* slopes : packets) {
        for (std::size_t k = begin; k < end; ++k) lowest[n] = min(lowest[n], load(slopes + k * lane_count));
        if (taken == SectorAzimuths::inside) continue;
        lowest[n] = min(lowest[n], min(load(slopes + before * lane_count), load(slopes + after * lane_count)));
      }
    }
    store(min_lanes(lowest), minima + first);
  }
  find_levels(horizon);
}

/// The edges that some receiver may see: a bit for each lane.
FARLOD_LANES std::uint32_t seen_edges(const EdgeReach& reach) { return bits_of(reach.max_slope > 0.0F); }

/// Those of them that may rise above some receiver's horizon.
FARLOD_LANES std::uint32_t raising_edges(const EdgeReach& reach, const SectorMinHorizon& horizon) {
  constexpr auto sectors = static_cast<std::int32_t>(SectorMinHorizon::sectors);
  // The sectors that the interval touches. Those of unbounded edges may be any, and are masked into the table
  const Ints first = truncate(reach.from * static_cast<float>(sectors)), last = truncate(reach.to * static_cast<float>(sectors));
  // Two runs of 2^level sectors, one from the first on and one up to the last, cover them
  const Ints level = floor_log2(min(max(last - first + 1, broadcast(1)), broadcast(sectors)));
  const std::array begin = to_array(level * sectors + (first & (sectors - 1))),
                   end = to_array(level * sectors + ((last + 1 - (1 << level)) & (sectors - 1)));
  std::array<float, lane_count> min_horizon;
  for (std::size_t l = 0; l < lane_count; ++l)
    min_horizon[l] =
        std::min(horizon.minima[static_cast<std::size_t>(begin[l])], horizon.minima[static_cast<std::size_t>(end[l])]);
  return bits_of(reach.max_slope > load(min_horizon.data()));
}

}  // namespace farlod
