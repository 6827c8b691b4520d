// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_kernel.hpp"

#include <algorithm>
#include <limits>

#include "horizon/edge_reach.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sector_min_horizon.hpp"
#include "horizon/silhouette_lanes.hpp"

namespace farlod {
namespace {

static_assert(ReceiverPacket::lanes == lane_count && SilhouetteEdges::lanes == lane_count);

/// The receivers' places.
struct Eyes {
  Floats x, y, z;
};

/// The ends of an edge as the receivers see them, and the inverse of p × q in the plan.
struct EdgeSeen {
  Floats px, py, pz, qx, qy, qz, inverse_turn;
};

FARLOD_LANES void see(const SilhouetteEdges::Batch& edges, std::size_t lane, const Eyes& eyes, EdgeSeen& s) {
  s.px = edges.ax[lane] - eyes.x;
  s.py = edges.ay[lane] - eyes.y;
  s.pz = edges.az[lane] - eyes.z;
  s.qx = edges.bx[lane] - eyes.x;
  s.qy = edges.by[lane] - eyes.y;
  s.qz = edges.bz[lane] - eyes.z;
}

/// An eye in line with the edge sees nothing of it.
FARLOD_LANES void turn_along(EdgeSeen& s) {
  const Floats turn = s.px * s.qy - s.py * s.qx, inverse = 1.0F / turn;
  s.inverse_turn = turn * turn > 0.0F ? inverse : broadcast(0.0F);
}

/// The same of an edge that may come as near as one likes. An eye within this (sine) of its line looks along it, or stands right
/// below it. Looked along, it has no width, and its plane gets no slope. From right below, it is seen as if the eye stood 1 mm
/// beside it. Returns whether any does.
enum class Beside { front, back };
FARLOD_LANES bool turn_along_near(EdgeSeen& s, Beside from_below) {
  constexpr float least_sine = 1e-5F, looked_along = std::numeric_limits<float>::infinity();
  const float right_below = from_below == Beside::front ? -1e-3F : 1e-3F;
  const Floats turn = s.px * s.qy - s.py * s.qx, squares = (s.px * s.px + s.py * s.py) * (s.qx * s.qx + s.qy * s.qy);
  const Floats off_line = turn * turn - least_sine * least_sine * squares;
  const Floats is_below = min(-off_line, -(s.px * s.qx + s.py * s.qy));
  const Floats wide = off_line > 0.0F ? turn : broadcast(looked_along);
  s.inverse_turn = 1.0F / (is_below > 0.0F ? broadcast(right_below) : wide);
  return max_lane(is_below) > 0.0F;
}

struct RingView {
  const float *cosine, *sine;
  const std::uint32_t *first_of_slot, *first_of_sector;
  std::uint32_t size;
  float slots;
};

/// Raises the horizons at some azimuths d. Where d meets the edge, 1/distance = u + v, and it parts the edge as u to v: so the
/// slope is p_z v + q_z u. Neighboring edges have the same d × p at the end that they share, but for the sign: no azimuth falls
/// between.
FARLOD_LANES void raise_rows(const EdgeSeen& s, float steepest, const RingView& ring, std::uint32_t first, std::uint32_t end,
                             float* slopes) {
  for (std::uint32_t k = first; k < end; ++k) {
    const float dx = ring.cosine[k], dy = ring.sine[k];
    const Floats u = (s.px * dy - s.py * dx) * s.inverse_turn, v = (s.qy * dx - s.qx * dy) * s.inverse_turn;
    // Next to in line with the edge, its plane is rounding: but it is never as steep as that
    const Floats slope = min(s.pz * v + s.qz * u, broadcast(steepest)), inside = min(u, v);
    float* row = slopes + std::size_t{k} * lane_count;
    store(max(load(row), inside >= 0.0F ? slope : broadcast(0.0F)), row);
  }
}

/// Horizons that rise to the edges.
struct Rising {
  float* slopes;
  FARLOD_LANES void draw(const EdgeSeen& s, float steepest, const RingView& ring, std::uint32_t first, std::uint32_t end) const {
    raise_rows(s, steepest, ring, first, end, slopes);
  }
};

/// Slopes that sink to the edges above some floors.
struct Sinking {
  const float* floors;
  float* slopes;
  FARLOD_LANES void draw(const EdgeSeen& s, float steepest, const RingView& ring, std::uint32_t first, std::uint32_t end) const {
    for (std::uint32_t k = first; k < end; ++k) {
      const float dx = ring.cosine[k], dy = ring.sine[k];
      const Floats u = (s.px * dy - s.py * dx) * s.inverse_turn, v = (s.qy * dx - s.qx * dy) * s.inverse_turn;
      const Floats slope = min(s.pz * v + s.qz * u, broadcast(steepest));
      const Floats over = slope - load(floors + std::size_t{k} * lane_count), counts = min(min(u, v), over);
      const Floats seen = counts > 0.0F ? slope : broadcast(std::numeric_limits<float>::infinity());
      float* row = slopes + std::size_t{k} * lane_count;
      store(min(load(row), seen), row);
    }
  }
};

/// The same from azimuth to azimuth, counted on from turn to turn.
template <class Drawing>
FARLOD_LANES void draw_around(const EdgeSeen& s, float steepest, const RingView& ring, std::uint32_t first, std::uint32_t end,
                              const Drawing& drawing) {
  const std::uint32_t turn = first < ring.size ? 0 : first < 2 * ring.size ? ring.size : 2 * ring.size;
  const std::uint32_t begin = first - turn, stop = end - turn;
  drawing.draw(s, steepest, ring, begin, std::min(stop, ring.size));
  if (stop > ring.size) drawing.draw(s, steepest, ring, 0, stop - ring.size);
}

/// Draws those edges of a batch that may rise over somebody's floors.
template <class Drawing>
FARLOD_LANES void draw_batch(const SilhouetteEdges::Batch& edges, const Eyes& eyes, const PacketBounds& bounds, bool is_upper,
                             const RingView& ring, const SectorMinHorizon& floors, const Drawing& drawing) {
  EdgeReach reach = reach_of(edges, bounds);
  if (max_lane(reach.steepest) <= 0.0F) return;
  const EyeBox box{bounds.x, bounds.y, bounds.half_x, bounds.half_y, bounds.lowest_z, bounds.highest_z};
  reach.steepest = may_be_silhouette(seen_edges(edges, box), edges, box, is_upper) > 0.0F ? reach.steepest : broadcast(-1.0F);
  std::array<std::uint8_t, lane_count> risers;
  const std::size_t count = edges_above_horizon(reach, floors, risers);
  const Ints first_slot = truncate(reach.from * ring.slots), end_slot = truncate(reach.to * ring.slots) + 1;
  EdgeSeen seen;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t lane = risers[n];
    see(edges, lane, eyes, seen);
    if (reach.steepest[lane] == EdgeReach::anything) {
      // An upper border hides the side that it faces away from (SilhouetteEdges); below a lower one, sky may be seen on both
      const bool is_overhead = turn_along_near(seen, Beside::front);
      drawing.draw(seen, EdgeReach::anything, ring, 0, ring.size);
      if (is_overhead && !is_upper) {
        turn_along_near(seen, Beside::back);
        drawing.draw(seen, EdgeReach::anything, ring, 0, ring.size);
      }
    } else {
      turn_along(seen);
      draw_around(seen, reach.steepest[lane], ring, ring.first_of_slot[first_slot[lane]], ring.first_of_slot[end_slot[lane]],
                  drawing);
    }
  }
}

FARLOD_FOR_EACH_PROCESSOR
void raise_over(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const PacketBounds& bounds, const RingView& ring,
                float* slopes) {
  const Eyes eyes{load(receivers.x.data()), load(receivers.y.data()), load(receivers.z.data())};
  const bool is_upper = edges.role() != EdgeRole::underside;
  SectorMinHorizon floors;
  // The nearest hide the most: what is hidden is found out again soon, then seldom
  std::size_t next_look = 0, looks_apart = 2 * lane_count;
  for (std::size_t begin = 0; begin < edges.size(); begin += lane_count) {
    if (begin >= next_look) {
      find_sector_minima(slopes, ring.first_of_sector, floors);
      next_look = begin + looks_apart;
      looks_apart *= 2;
    }
    draw_batch(edges.batches()[begin / lane_count], eyes, bounds, is_upper, ring, floors, Rising{slopes});
  }
}

FARLOD_FOR_EACH_PROCESSOR
void sink_over(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const PacketBounds& bounds, const RingView& ring,
               const float* floor_slopes, float* slopes) {
  const Eyes eyes{load(receivers.x.data()), load(receivers.y.data()), load(receivers.z.data())};
  const bool is_upper = edges.role() != EdgeRole::underside;
  SectorMinHorizon floors;
  find_sector_minima(floor_slopes, ring.first_of_sector, floors);
  for (std::size_t begin = 0; begin < edges.size(); begin += lane_count)
    draw_batch(edges.batches()[begin / lane_count], eyes, bounds, is_upper, ring, floors, Sinking{floor_slopes, slopes});
}

/// Receivers that look the same way, and not down, have the plane through the hindmost of them: what lies behind it, with all
/// that is below it, is in nobody's sight. For others, nothing lies behind.
void add_plane(const ReceiverPacket& r, PacketBounds& b) {
  bool alike = r.normal_z[0] >= 0.0F;
  float hindmost = std::numeric_limits<float>::infinity();
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    alike = alike && r.normal_x[l] == r.normal_x[0] && r.normal_y[l] == r.normal_y[0] && r.normal_z[l] == r.normal_z[0];
    hindmost = std::min(hindmost, r.normal_x[0] * r.x[l] + r.normal_y[0] * r.y[l] + r.normal_z[0] * r.z[l]);
  }
  b.depth = alike ? hindmost : -1.0F;
  if (!alike) return;
  b.normal_x = r.normal_x[0];
  b.normal_y = r.normal_y[0];
  b.normal_z = r.normal_z[0];
}

RingView view_of(const AzimuthRing& ring) {
  return {ring.cosine(),
          ring.sine(),
          ring.first_of_slot(),
          ring.first_of_sector(),
          static_cast<std::uint32_t>(ring.size()),
          static_cast<float>(ring.slots())};
}

PacketBounds bounds_of(const ReceiverPacket& r) {
  PacketBounds b;
  const auto [west, east] = std::minmax_element(r.x.begin(), r.x.end());
  const auto [south, north] = std::minmax_element(r.y.begin(), r.y.end());
  b.x = 0.5F * (*west + *east);
  b.y = 0.5F * (*south + *north);
  b.half_x = 0.5F * (*east - *west);
  b.half_y = 0.5F * (*north - *south);
  b.lowest_z = r.lowest_z();
  b.highest_z = *std::max_element(r.z.begin(), r.z.end());
  add_plane(r, b);
  return b;
}

}  // namespace

void raise_horizons(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const AzimuthRing& ring, float* slopes) {
  if (edges.empty()) return;
  raise_over(edges, receivers, bounds_of(receivers), view_of(ring), slopes);
}

void lower_to_edges(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const AzimuthRing& ring, const float* floors,
                    float* lowest) {
  if (edges.empty()) return;
  sink_over(edges, receivers, bounds_of(receivers), view_of(ring), floors, lowest);
}

}  // namespace farlod
