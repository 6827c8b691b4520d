// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "horizon/edge_reach.hpp"
#include "horizon/lanes.hpp"

namespace farlod {
namespace {

static_assert(ReceiverPacket::lanes == lane_count && SkylineEdges::lanes == lane_count);

/// An edge that an eye sees end-on, within this (sine of the angle), covers less than a thousandth of an azimuth's part, and its
/// plane is rounding: it is left out.
constexpr float least_sine = 1e-5F;
/// The receivers' places.
struct Eyes {
  Floats x, y, z;
};

/// An edge as the receivers see it: the plane through it and each of them, and between which azimuths it stands, as diamond_turns
/// that all count from the same turn.
struct PlacedEdge {
  Floats along_x, along_y, from, to;
};

struct Edge {
  float ax, ay, az, bx, by, bz;
};

/// Where the ends of the edge lie from the eyes.
struct EdgeSeen {
  Floats px, py, pz, qx, qy, qz;
};

FARLOD_LANES EdgeSeen seen_from(const Eyes& eyes, const Edge& e) {
  return {e.ax - eyes.x, e.ay - eyes.y, e.az - eyes.z, e.bx - eyes.x, e.by - eyes.y, e.bz - eyes.z};
}

FARLOD_LANES void place_plane(const EdgeSeen& s, const Floats& turn, PlacedEdge& placed) {
  const Floats scale = -1.0F / turn;
  placed.along_x = (s.py * s.qz - s.pz * s.qy) * scale;
  placed.along_y = (s.pz * s.qx - s.px * s.qz) * scale;
}

/// An eye within this (sine) of the line of the edge looks along it, or stands right below it. Looked along, an edge has no
/// width: its plane gets next to no slope. From right below, it hides the side that it faces away from (SkylineEdges), as if the
/// eye stood 1 mm in front.
FARLOD_LANES void place(const EdgeSeen& s, PlacedEdge& placed) {
  constexpr float looked_along = 1e30F, right_below = -1e-3F;
  const Floats turn = s.px * s.qy - s.py * s.qx, squares = (s.px * s.px + s.py * s.py) * (s.qx * s.qx + s.qy * s.qy);
  const Floats off_line = turn * turn - least_sine * least_sine * squares;
  const Floats is_below = least(-off_line, -(s.px * s.qx + s.py * s.qy));
  const Floats wide = off_line > 0.0F ? turn : all(looked_along);
  place_plane(s, is_below > 0.0F ? all(right_below) : wide, placed);
  const Floats p_turns = diamond_turns(s.px, s.py), q_turns = diamond_turns(s.qx, s.qy), base = all(p_turns[0]);
  const Floats p = base + within_half_a_turn(p_turns - base), width = within_half_a_turn(q_turns - p_turns);
  const Floats q = p + (is_below > 0.0F ? all(-0.5F) : width);
  placed.from = least(p, q);
  placed.to = greatest(p, q);
}

struct RingView {
  const std::int32_t* steps;
  const float *turns, *cosine, *sine;
  const std::uint32_t *first_of_slot, *first_of_sector;
  std::uint32_t size;
};

/// The first azimuth at or beyond one that lies within a turn; the ring's size when there is none.
FARLOD_LANES std::uint32_t first_from(const RingView& ring, std::int32_t azimuth) {
  std::uint32_t k = ring.first_of_slot[static_cast<std::uint64_t>(azimuth) * ring.size / one_turn];
  while (k < ring.size && ring.steps[k] < azimuth) ++k;
  return k;
}

FARLOD_LANES void raise_by(const PlacedEdge& placed, const RingView& ring, float* slopes) {
  const std::int32_t begin = least_lane(steps_of(placed.from)), end = greatest_lane(steps_of(placed.to));
  std::int32_t turn = begin < 0 ? -1 : begin < one_turn ? 0 : 1;
  std::uint32_t k = first_from(ring, begin - turn * one_turn);
  while (true) {
    if (k == ring.size) {
      k = 0;
      ++turn;
    }
    if (ring.steps[k] + turn * one_turn > end) break;
    float* row = slopes + std::size_t{k} * lane_count;
    const Floats azimuth = all(ring.turns[k] + static_cast<float>(turn));
    const Floats slope = placed.along_x * ring.cosine[k] + placed.along_y * ring.sine[k];
    const Floats inside = least(azimuth - placed.from, placed.to - azimuth);
    store(greatest(loaded(row), inside >= 0.0F ? slope : all(0.0F)), row);
    ++k;
  }
}

FARLOD_LANES void find_floors(const float* slopes, const std::uint32_t* first_of_sector, SectorFloors& floors) {
  for (std::size_t s = 0; s < floors.size(); ++s) {
    Floats lowest = all(EdgeReach::anything);
    for (std::size_t k = first_of_sector[s]; k < first_of_sector[s + 1]; ++k)
      lowest = least(lowest, loaded(slopes + k * lane_count));
    floors[s] = least_lane(lowest);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void raise_over(const SkylineEdges& edges, const ReceiverPacket& receivers, const PacketBounds& bounds, const RingView& ring,
                float* slopes) {
  const Eyes eyes{loaded(receivers.x.data()), loaded(receivers.y.data()), loaded(receivers.z.data())};
  SectorFloors floors;
  std::array<std::uint8_t, lane_count> risers;
  PlacedEdge placed;
  // The nearest hide the most: what is hidden is found out again soon, then seldom
  std::size_t next_look = 0, looks_apart = 2 * lane_count;
  for (std::size_t begin = 0; begin < edges.size(); begin += lane_count) {
    if (begin >= next_look) {
      find_floors(slopes, ring.first_of_sector, floors);
      next_look = begin + looks_apart;
      looks_apart *= 2;
    }
    const SkylineEdges::Batch& batch = edges.batches()[begin / lane_count];
    const EdgeReach reach = reach_of(batch, bounds);
    const std::size_t count = find_risers(reach, floors, risers);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t l = risers[n];
      const EdgeSeen seen = seen_from(eyes, {batch.ax[l], batch.ay[l], batch.az[l], batch.bx[l], batch.by[l], batch.bz[l]});
      place(seen, placed);
      raise_by(placed, ring, slopes);
    }
  }
}

/// Receivers that look the same way, and not down, have the plane through the hindmost of them: what lies behind it, with all
/// that is below it, is in nobody's sight. For others, nothing lies behind.
PacketBounds bounds_of(const ReceiverPacket& r) {
  PacketBounds b;
  const auto [west, east] = std::minmax_element(r.x.begin(), r.x.end());
  const auto [south, north] = std::minmax_element(r.y.begin(), r.y.end());
  b.x = 0.5F * (*west + *east);
  b.y = 0.5F * (*south + *north);
  b.lowest_z = r.lowest_z();
  bool alike = r.normal_z[0] >= 0.0F;
  float hindmost = std::numeric_limits<float>::infinity();
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    const float x = r.x[l] - b.x, y = r.y[l] - b.y;
    b.radius = std::max(b.radius, std::sqrt(x * x + y * y));
    alike = alike && r.normal_x[l] == r.normal_x[0] && r.normal_y[l] == r.normal_y[0] && r.normal_z[l] == r.normal_z[0];
    hindmost = std::min(hindmost, r.normal_x[0] * r.x[l] + r.normal_y[0] * r.y[l] + r.normal_z[0] * r.z[l]);
  }
  b.depth = alike ? hindmost : -1.0F;
  if (!alike) return b;
  b.normal_x = r.normal_x[0];
  b.normal_y = r.normal_y[0];
  b.normal_z = r.normal_z[0];
  return b;
}

}  // namespace

void raise_horizons(const SkylineEdges& edges, const ReceiverPacket& receivers, const AzimuthRing& ring, float* slopes) {
  const RingView view{ring.steps(),
                      ring.turns(),
                      ring.cosine(),
                      ring.sine(),
                      ring.first_of_slot(),
                      ring.first_of_sector(),
                      static_cast<std::uint32_t>(ring.size())};
  raise_over(edges, receivers, bounds_of(receivers), view, slopes);
}

}  // namespace farlod
