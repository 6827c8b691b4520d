// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "horizon/edge_culling.hpp"
#include "horizon/lanes.hpp"
#include "horizon/overhang_facets.hpp"

/// What edge_culling.hpp is for edges, for triangles, sixteen at once.
namespace farlod {

/// A triangle's corners in the plan, relative to the centre of a box.
struct PlanOfFacet {
  Floats x[3], y[3];
};

/// Whether the centre lies in the triangle or on its border: not all crosses of a triangle that it lies outside of have one sign.
FARLOD_LANES Mask holds_center(const PlanOfFacet& t) {
  Floats least = broadcast(EdgeReach::unbounded), most = broadcast(-EdgeReach::unbounded);
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t next = n == 2 ? 0 : n + 1;
    const Floats cross = t.x[n] * t.y[next] - t.y[n] * t.x[next];
    least = min(least, cross);
    most = max(most, cross);
  }
  return max(least, -most) >= 0.0F;
}

/// The hull of the azimuths of the corners.
FARLOD_LANES EdgeReach azimuths_of(const PlanOfFacet& t, const CenteredBox& box) {
  const Floats start = azimuths_from_rectangle(t.x[0], t.y[0], box.half_x, box.half_y).from;
  Floats from = start, to = start;
  for (std::size_t n = 0; n < 3; ++n) {
    const AzimuthInterval corner = azimuths_from_rectangle(t.x[n], t.y[n], box.half_x, box.half_y);
    from = min(from, start + within_half_a_turn(corner.from - start));
    to = max(to, start + within_half_a_turn(corner.to - start));
  }
  return {Floats{}, from + (1.0F - reach_margin), to + (1.0F + reach_margin)};
}

FARLOD_LANES Floats slope_bound_of(const PlanOfFacet& t, const Floats& rise, const CenteredBox& box) {
  Floats bound = broadcast(0.0F);
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t next = n == 2 ? 0 : n + 1;
    bound = max(bound, slope_bound({t.x[n], t.y[n], t.x[next], t.y[next]}, rise, box));
  }
  return choose(holds_center(t), broadcast(EdgeReach::unbounded), bound);
}

/// What reach_of is of edges, of triangles. The steepest place of a triangle beside the box is on one of its edges, and azimuths
/// are those of its corners.
FARLOD_LANES EdgeReach reach_of_facets(const OverhangFacets::Batch& facets, const PacketBounds& packet) {
  const CenteredBox& box = packet.box;
  PlanOfFacet t;
  Floats highest = broadcast(-EdgeReach::unbounded), in_front = broadcast(-EdgeReach::unbounded);
  for (std::size_t n = 0; n < 3; ++n) {
    const Floats x = load(facets.x[n].data()), y = load(facets.y[n].data()), z = load(facets.z[n].data());
    highest = max(highest, z);
    in_front = max(in_front, packet.normal_x * x + packet.normal_y * y + packet.normal_z * z);
    t.x[n] = x - box.x;
    t.y[n] = y - box.y;
  }
  const Floats rise = highest - box.low_z, bound = slope_bound_of(t, rise, box);
  EdgeReach reach = azimuths_of(t, box);
  // A triangle that is too close for bounds may be anywhere
  const Mask is_near = bound == EdgeReach::unbounded;
  reach.from = choose(is_near, broadcast(1.0F), reach.from);
  reach.to = choose(is_near, broadcast(2.0F - reach_margin), reach.to);
  reach.max_slope = choose(min(rise, in_front - packet.depth) > 0.0F, bound, broadcast(-1.0F));
  return reach;
}

/// The same of boxes: a box is no nearer than its sides are, its azimuths are those of its corners.
FARLOD_LANES EdgeReach reach_of_boxes(const OverhangFacets::Boxes& boxes, const PacketBounds& packet) {
  const CenteredBox& box = packet.box;
  const Floats low_x = load(boxes.low_x.data()), high_x = load(boxes.high_x.data()), low_y = load(boxes.low_y.data()),
               high_y = load(boxes.high_y.data()), low_z = load(boxes.low_z.data()), high_z = load(boxes.high_z.data());
  const PlanOfFacet first{{low_x - box.x, high_x - box.x, high_x - box.x}, {low_y - box.y, low_y - box.y, high_y - box.y}};
  const PlanOfFacet second{{low_x - box.x, high_x - box.x, low_x - box.x}, {low_y - box.y, high_y - box.y, high_y - box.y}};
  const Floats rise = high_z - box.low_z;
  const Floats bound = max(slope_bound_of(first, rise, box), slope_bound_of(second, rise, box));
  // Both triangles begin at the same corner
  EdgeReach reach = azimuths_of(first, box);
  const EdgeReach other = azimuths_of(second, box);
  const Mask is_near = bound == EdgeReach::unbounded;
  reach.from = choose(is_near, broadcast(1.0F), min(reach.from, other.from));
  reach.to = choose(is_near, broadcast(2.0F - reach_margin), max(reach.to, other.to));
  const Floats in_front = max(packet.normal_x * low_x, packet.normal_x * high_x) +
                          max(packet.normal_y * low_y, packet.normal_y * high_y) +
                          max(packet.normal_z * low_z, packet.normal_z * high_z) - packet.depth;
  reach.max_slope = choose(min(rise, in_front) > 0.0F, bound, broadcast(-1.0F));
  return reach;
}

}  // namespace farlod
