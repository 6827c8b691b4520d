// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "horizon/edge_crossing.hpp"
#include "horizon/edge_culling.hpp"
#include "horizon/kernels.hpp"
#include "horizon/lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

static_assert(ReceiverPacket::lanes == lane_count && SilhouetteEdges::lanes == lane_count);

/// The places of the receivers, one a lane.
struct Places {
  Floats x, y, z;
};

FARLOD_LANES void set_ends(const SilhouetteEdges::Batch& edges, std::size_t lane, const Places& r, RelativeEdge& e) {
  e.px = edges.ax[lane] - r.x;
  e.py = edges.ay[lane] - r.y;
  e.pz = edges.az[lane] - r.z;
  e.qx = edges.bx[lane] - r.x;
  e.qy = edges.by[lane] - r.y;
  e.qz = edges.bz[lane] - r.z;
}

/// The edge is clear of the packet. A receiver in line with the edge sees no width of it: its inverse is 0, which gives the slope
/// 0.
FARLOD_LANES void invert_cross(RelativeEdge& e) {
  const Floats cross = e.px * e.qy - e.py * e.qx, inverse = 1.0F / cross;
  e.inverse_cross = choose(cross * cross > 0.0F, inverse, broadcast(0.0F));
}

/// A lower border that faces away from a receiver, though not from all of the packet, has no width for it. If it counted, the
/// receiver's gaps would depend on which others are in the packet.
FARLOD_LANES void hide_facing_away(const SilhouetteEdges::Batch& edges, std::size_t lane, const Places& r, RelativeEdge& e) {
  const FacedEdges faced = faced_edge(edges, lane);
  const FacingBoxes boxes = facing_boxes(r.x, r.y, r.z);
  const Floats faces = may_be_silhouette(facing_terms(faced, boxes), faced, boxes, false);
  e.inverse_cross = choose(faces > 0.0F, e.inverse_cross, broadcast(0.0F));
}

/// On which side of an edge right above it a receiver is taken to stand.
enum class Beside { front, back };

/// The edge may be close, or above a receiver. A receiver within `end_on_sine` of the edge's line
///   * in front of both ends, or behind both, sees the edge end-on: it has no width, and the slope 0;
///   * between the ends stands right below the edge: p × q is replaced as if it stood 1 mm beside it.
/// Returns whether any receiver stands right below.
FARLOD_LANES bool invert_cross_nearby(RelativeEdge& e, Beside side) {
  constexpr float no_width = std::numeric_limits<float>::infinity();
  const float cross_below = side == Beside::front ? -1e-3F : 1e-3F;
  const Floats cross = e.px * e.qy - e.py * e.qx, off_line = off_line_of(e, cross);
  // p · q < 0: the receiver is between the ends
  const Floats is_below = min(-off_line, -(e.px * e.qx + e.py * e.qy));
  const Floats wide = choose(off_line > 0.0F, cross, broadcast(no_width));
  e.inverse_cross = 1.0F / choose(is_below > 0.0F, broadcast(cross_below), wide);
  return max_lane(is_below) > 0.0F;
}

/// Horizons that rise to the edges: t_k = max(t_k, slope) where d_k hits the edge.
struct RaiseHorizon {
  static constexpr SectorAzimuths culled_at = SectorAzimuths::inside;
  float* slopes;
  FARLOD_LANES void keep(std::int32_t, float, std::uint32_t, std::uint32_t) const {}
  FARLOD_LANES void draw(const RelativeEdge& e, std::int32_t, float max_slope, const AzimuthView& a, std::uint32_t first,
                         std::uint32_t end) const {
    for (std::uint32_t k = first; k < end; ++k) {
      const Crossing c = crossing_of(e, max_slope, a.cosine[k], a.sine[k]);
      float* row = slopes + std::size_t{k} * lane_count;
      store(max(load(row), choose(c.inside >= 0.0F, c.slope, broadcast(0.0F))), row);
    }
  }
};

/// The same, with the number of the edge that each slope is of.
struct RaiseNumberedHorizon {
  static constexpr SectorAzimuths culled_at = SectorAzimuths::inside;
  float* slopes;
  std::int32_t* numbers;
  FARLOD_LANES void keep(std::int32_t, float, std::uint32_t, std::uint32_t) const {}
  FARLOD_LANES void draw(const RelativeEdge& e, std::int32_t number, float max_slope, const AzimuthView& a, std::uint32_t first,
                         std::uint32_t end) const {
    for (std::uint32_t k = first; k < end; ++k) {
      const Crossing c = crossing_of(e, max_slope, a.cosine[k], a.sine[k]);
      float* row = slopes + std::size_t{k} * lane_count;
      std::int32_t* edges = numbers + std::size_t{k} * lane_count;
      const Floats before = load(row), slope = choose(c.inside >= 0.0F, c.slope, broadcast(0.0F));
      const Mask is_higher = slope > before;
      store(choose(is_higher, slope, before), row);
      store(choose(is_higher, broadcast(number), load(edges)), edges);
    }
  }
};

/// The same, with the spans of all edges that may rise above them, between the azimuths, too.
struct RaiseTrackedHorizon : RaiseNumberedHorizon {
  static constexpr SectorAzimuths culled_at = SectorAzimuths::and_beside;
  RoomForSpans drawn;
  std::size_t& count;
  FARLOD_LANES void keep(std::int32_t number, float max_slope, std::uint32_t first_wedge, std::uint32_t wedges) const {
    drawn.number[count] = static_cast<std::uint32_t>(number);
    drawn.first[count] = static_cast<std::int32_t>(first_wedge);
    drawn.count[count] = static_cast<std::int32_t>(wedges);
    drawn.max_slope[count++] = max_slope;
  }
};

/// Horizons that are lowered to the edges above the minimum m: t_k = min(t_k, slope) where d_k hits the edge and slope > m_k.
struct LowerHorizon {
  const float* min_slopes;
  float* slopes;
  FARLOD_LANES void keep(std::int32_t, float, std::uint32_t, std::uint32_t) const {}
  FARLOD_LANES void draw(const RelativeEdge& e, std::int32_t, float max_slope, const AzimuthView& a, std::uint32_t first,
                         std::uint32_t end) const {
    for (std::uint32_t k = first; k < end; ++k) {
      const Crossing c = crossing_of(e, max_slope, a.cosine[k], a.sine[k]);
      // One condition: a receiver in line with the edge has u = v = 0, and must not see it here
      const Floats counts = min(c.inside, c.slope - load(min_slopes + std::size_t{k} * lane_count));
      const Floats seen = choose(counts > 0.0F, c.slope, broadcast(std::numeric_limits<float>::infinity()));
      float* row = slopes + std::size_t{k} * lane_count;
      store(min(load(row), seen), row);
    }
  }
};

/// Draws an edge at the azimuths from `first` to `end`, counted on over three turns: at most two runs of one turn.
template <class Horizon>
FARLOD_LANES void draw_interval(const RelativeEdge& e, std::int32_t number, float max_slope, const AzimuthView& a,
                                std::uint32_t first, std::uint32_t end, const Horizon& horizon) {
  const std::uint32_t turn = first < a.size ? 0 : first < 2 * a.size ? a.size : 2 * a.size;
  const std::uint32_t begin = first - turn, stop = end - turn;
  horizon.draw(e, number, max_slope, a, begin, std::min(stop, a.size));
  if (stop > a.size) horizon.draw(e, number, max_slope, a, 0, stop - a.size);
}

/// Draws an edge that is too close for bounds at all azimuths.
template <class Horizon>
FARLOD_LANES void draw_nearby(const SilhouetteEdges::Batch& edges, std::size_t lane, bool is_upper, const Places& receivers,
                              const AzimuthView& a, const Horizon& horizon) {
  RelativeEdge e;
  const std::int32_t number = edges.number[lane];
  set_ends(edges, lane, receivers, e);
  // An upper border hides the side that it faces away from (SilhouetteEdges::add); below a lower one, sky may be seen on both
  const bool is_overhead = invert_cross_nearby(e, Beside::front);
  if (!is_upper) hide_facing_away(edges, lane, receivers, e);
  horizon.draw(e, number, EdgeReach::unbounded, a, 0, a.size);
  if (is_overhead && !is_upper) {
    invert_cross_nearby(e, Beside::back);
    hide_facing_away(edges, lane, receivers, e);
    horizon.draw(e, number, EdgeReach::unbounded, a, 0, a.size);
  }
}

/// Draws those edges of a batch that can change a horizon above `min_horizon`, if there is one.
template <class Horizon>
FARLOD_LANES void draw_batch(const SilhouetteEdges::Batch& edges, bool is_upper, const Places& receivers,
                             const PacketBounds& bounds, const AzimuthView& azimuths, const SectorMinHorizon* min_horizon,
                             const Horizon& horizon) {
  // Leave out what is hidden already, or below all receivers, or behind them; then what faces away from all of them
  const EdgeReach reach = reach_of(edges, bounds);
  std::uint32_t kept = min_horizon != nullptr ? raising_edges(reach, *min_horizon) : seen_edges(reach);
  if (kept == 0) return;
  const FacingEdges facing = facing_edges(edges, bounds.box, is_upper);
  kept &= facing.some;
  // Draw the others one by one, each for sixteen receivers, between its first and last slot
  const std::array first_slot = to_array(truncate(reach.from * azimuths.slots)),
                   end_slot = to_array(truncate(reach.to * azimuths.slots) + 1);
  const std::array max_slope = to_array(reach.max_slope);
  RelativeEdge e;
  for (; kept != 0; kept &= kept - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(kept));
    if (max_slope[lane] == EdgeReach::unbounded) {
      horizon.keep(edges.number[lane], max_slope[lane], 0, azimuths.size);
      draw_nearby(edges, lane, is_upper, receivers, azimuths, horizon);
      continue;
    }
    // Small and distant edges may lie between two azimuths
    const std::uint32_t first = azimuths.first_of_slot[first_slot[lane]], end = azimuths.first_of_slot[end_slot[lane]];
    horizon.keep(edges.number[lane], max_slope[lane], within_turn(first - 1, azimuths.size),
                 std::min(end - first + 1, azimuths.size));
    if (first == end) continue;
    set_ends(edges, lane, receivers, e);
    invert_cross(e);
    if (has_bit(facing.doubtful, lane)) hide_facing_away(edges, lane, receivers, e);
    draw_interval(e, edges.number[lane], max_slope[lane], azimuths, first, end, horizon);
  }
}

FARLOD_LANES Places places_of(const ReceiverPacket& r) { return {load(r.x.data()), load(r.y.data()), load(r.z.data())}; }

/// The batch before which minima are found, and after how many more for the second time: for each Culling.
struct Renewal {
  std::size_t first, apart;
};
constexpr Renewal renewals[] = {{0, 2}, {0, 12}, {8, 8}};

template <class Horizon>
FARLOD_LANES void raise_horizon(const EdgeBatches& edges, const ReceiverPacket& receivers, const PacketBounds& bounds,
                                const AzimuthView& azimuths, Culling culling, const Horizon& drawn) {
  const Places places = places_of(receivers);
  const bool is_upper = edges.role != EdgeRole::underside;
  const float* const slopes = drawn.slopes;
  // Minima are renewed after more and more batches. Those that are out of date are too low, and let more edges be drawn, never
  // fewer
  SectorMinHorizon min_horizon;
  const Renewal& renewal = renewals[static_cast<std::size_t>(culling)];
  for (std::size_t n = 0, next = renewal.first, apart = renewal.apart; n < edges.batches.size(); ++n) {
    if (n == next) {
      find_sector_minima({&slopes, 1}, azimuths, Horizon::culled_at, min_horizon);
      next += apart;
      apart *= 2;
    }
    draw_batch(edges.batches[n], is_upper, places, bounds, azimuths, n < renewal.first ? nullptr : &min_horizon, drawn);
  }
}

std::size_t raise_to_edges(const EdgeBatches& edges, const ReceiverPacket& receivers, const PacketBounds& bounds,
                           const AzimuthView& azimuths, Culling culling, const DrawnRows& rows) {
  std::size_t count = 0;
  if (rows.numbers == nullptr)
    raise_horizon(edges, receivers, bounds, azimuths, culling, RaiseHorizon{rows.slopes});
  else if (rows.drawn.number == nullptr)
    raise_horizon(edges, receivers, bounds, azimuths, culling, RaiseNumberedHorizon{rows.slopes, rows.numbers});
  else
    raise_horizon(edges, receivers, bounds, azimuths, culling,
                  RaiseTrackedHorizon{{rows.slopes, rows.numbers}, rows.drawn, count});
  return count;
}

void lower_to_edges(const EdgeBatches& edges, const ReceiverPacket& receivers, const PacketBounds& bounds,
                    const AzimuthView& azimuths, const float* min_slopes, float* slopes) {
  const Places places = places_of(receivers);
  const bool is_upper = edges.role != EdgeRole::underside;
  // The minimum does not change while edges are drawn
  SectorMinHorizon min_horizon;
  find_sector_minima({&min_slopes, 1}, azimuths, SectorAzimuths::inside, min_horizon);
  for (const SilhouetteEdges::Batch& batch : edges.batches)
    draw_batch(batch, is_upper, places, bounds, azimuths, &min_horizon, LowerHorizon{min_slopes, slopes});
}

void find_raising(const EdgeBatches& edges, const PacketBounds& bounds, std::span<const float* const> horizons,
                  const AzimuthView& azimuths, RaisingAt where, std::uint16_t* raising) {
  SectorMinHorizon min_horizon;
  const SectorAzimuths taken = where == RaisingAt::azimuths ? SectorAzimuths::inside : SectorAzimuths::and_beside;
  find_sector_minima(horizons, azimuths, taken, min_horizon);
  for (const SilhouetteEdges::Batch& batch : edges.batches)
    *raising++ = static_cast<std::uint16_t>(raising_edges(reach_of(batch, bounds), min_horizon));
}

void find_facing(const EdgeBatches& edges, const CenteredBox& box, float* distances_m) {
  const bool is_upper = edges.role != EdgeRole::underside;
  const FacingBoxes boxes = facing_boxes(box);
  for (const SilhouetteEdges::Batch& batch : edges.batches) {
    const FacedEdges faced = faced_edges(batch);
    const FacingTerms t = facing_terms(faced, boxes);
    // An edge below all receivers is no silhouette
    const Floats highest = max(t.along_z, broadcast(0.0F)) + t.a_z;
    const Floats kept = choose(highest > box.low_z, may_be_silhouette(t, faced, boxes, is_upper), broadcast(-1.0F));
    store(choose(kept > 0.0F, distance_from_center(t), broadcast(-1.0F)), distances_m);
    distances_m += lane_count;
  }
}

}  // namespace

namespace FARLOD_TARGET {
extern const EdgeKernels edge_kernels;
constexpr EdgeKernels edge_kernels{find_facing, find_raising, raise_to_edges, lower_to_edges};
}  // namespace FARLOD_TARGET

}  // namespace farlod
