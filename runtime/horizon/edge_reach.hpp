// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "horizon/lanes.hpp"
#include "horizon/silhouette_edges.hpp"

/// From where the receivers of a packet can see edges, sixteen edges at once. Proof in docs/concepts.md, "Edges that a packet
/// passes over".
namespace farlod {

/// What the receivers of a packet have in common: an upright box around them, given by the middle of its plan, half its sides and
/// its floor and top; and a plane behind which none of them looks: normal · p ≤ depth.
struct PacketBounds {
  float x = 0.0F, y = 0.0F, half_x = 0.0F, half_y = 0.0F, lowest_z = 0.0F, highest_z = 0.0F;
  float normal_x = 0.0F, normal_y = 0.0F, normal_z = 0.0F, depth = 0.0F;
};

/// Of some edges: how steep any receiver can see them, at the most: less than 0 for those that nobody sees, `anything` for those
/// that are too near to tell. And between which azimuths, as pseudo_angle from 0 to 3, counted on from turn to turn; of edges
/// that are too near, they say nothing.
struct EdgeReach {
  static constexpr float anything = std::numeric_limits<float>::infinity();
  Floats steepest, from, to;
};

/// Bounds give way by this share, and azimuths by this many turns: many times the rounding of floats.
inline constexpr float reach_margin = 1e-4F;
/// An edge that comes this near to the box, or into it, may be seen anywhere around: many times the rounding of floats, too.
inline constexpr float least_clear_m = 0.01F;

FARLOD_LANES Floats within_half_a_turn(const Floats& turns) {
  return turns > 0.5F ? turns - 1.0F : turns < -0.5F ? turns + 1.0F : turns;
}

/// The outermost azimuths, as pseudo_angle, at which a rectangle around the origin sees points outside it: those of two corners.
/// If the point lies beyond both sides of a corner, the corners to the left and right of that one; else the two of the side
/// that it lies in front of.
struct Outermost {
  Floats from, to;
};
FARLOD_LANES Outermost outermost(const Floats& x, const Floats& y, float half_x, float half_y) {
  const Floats x_towards_x = x < 0.0F ? broadcast(-half_x) : broadcast(half_x), x_towards_y = y < 0.0F ? broadcast(-half_x) : broadcast(half_x);
  const Floats y_towards_x = x < 0.0F ? broadcast(-half_y) : broadcast(half_y), y_towards_y = y < 0.0F ? broadcast(-half_y) : broadcast(half_y);
  const Floats beyond_x = abs(x) - half_x, beyond_y = abs(y) - half_y;
  const Floats from_x = beyond_y > 0.0F ? -x_towards_y : x_towards_x, from_y = beyond_x > 0.0F ? y_towards_x : y_towards_y;
  const Floats to_x = beyond_y > 0.0F ? x_towards_y : x_towards_x, to_y = beyond_x > 0.0F ? -y_towards_x : y_towards_y;
  return {pseudo_angle(x - from_x, y - from_y), pseudo_angle(x - to_x, y - to_y)};
}

/// Edges as the middle of the box sees them in the plan.
struct EdgesFromMiddle {
  Floats px, py, qx, qy;
};

/// High over the box's floor, how steep they are at the most.
FARLOD_LANES Floats steepest_slope(const EdgesFromMiddle& e, const Floats& high, const PacketBounds& box) {
  const Floats along_x = e.qx - e.px, along_y = e.qy - e.py, along_square = along_x * along_x + along_y * along_y;
  const Floats share = -(e.px * along_x + e.py * along_y) / (along_square > 0.0F ? along_square : broadcast(1.0F));
  const Floats s = min(max(share, broadcast(0.0F)), broadcast(1.0F));
  const Floats nearest_x = e.px + s * along_x, nearest_y = e.py + s * along_y;
  const Floats square = nearest_x * nearest_x + nearest_y * nearest_y, distance = sqrt(square);
  // Both times the distance: what lies between box and edge on the shortest way, and the least that is enough
  const Floats clear = square - abs(nearest_x) * box.half_x - abs(nearest_y) * box.half_y;
  const Floats enough = least_clear_m * distance;
  const Floats bound = high * distance / max(clear, broadcast(least_clear_m * least_clear_m)) * (1.0F + reach_margin) + reach_margin;
  return clear > enough ? bound : broadcast(EdgeReach::anything);
}

FARLOD_LANES EdgeReach reach_of(const SilhouetteEdges::Batch& edges, const PacketBounds& box) {
  const Floats ax = load(edges.ax.data()), ay = load(edges.ay.data()), az = load(edges.az.data());
  const Floats bx = load(edges.bx.data()), by = load(edges.by.data()), bz = load(edges.bz.data());
  const EdgesFromMiddle e{ax - box.x, ay - box.y, bx - box.x, by - box.y};
  const Floats high = max(az, bz) - box.lowest_z;
  const Floats front = max(box.normal_x * ax + box.normal_y * ay + box.normal_z * az,
                                box.normal_x * bx + box.normal_y * by + box.normal_z * bz) -
                       box.depth;
  EdgeReach reach;
  const Floats bound = steepest_slope(e, high, box);
  reach.steepest = min(high, front) > 0.0F ? bound : broadcast(-1.0F);
  const Outermost a = outermost(e.px, e.py, box.half_x, box.half_y), b = outermost(e.qx, e.qy, box.half_x, box.half_y);
  // All lie within half a turn of each other, since box and edge can be parted by a line
  const Floats a_to = a.from + within_half_a_turn(a.to - a.from);
  const Floats b_from = a.from + within_half_a_turn(b.from - a.from), b_to = a.from + within_half_a_turn(b.to - a.from);
  // A turn more, so that whole parts round down
  reach.from = min(a.from, b_from) + (1.0F - reach_margin);
  reach.to = max(a_to, b_to) + (1.0F + reach_margin);
  return reach;
}

}  // namespace farlod
