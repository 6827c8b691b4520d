// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "horizon/azimuth_ring.hpp"
#include "horizon/lanes.hpp"
#include "horizon/skyline_edges.hpp"

/// Which edges of a list some receiver of a packet can see, told for all receivers at once. Proof in docs/concepts.md, "Edges
/// that a packet passes over".
namespace farlod {

/// What the receivers of a packet have in common: a circle around them, how low the lowest is, and a plane behind which none of
/// them looks: normal · p ≤ depth.
struct PacketBounds {
  float x = 0.0F, y = 0.0F, radius = 0.0F, lowest_z = 0.0F;
  float normal_x = 0.0F, normal_y = 0.0F, normal_z = 0.0F, depth = 0.0F;
};

/// In each sector of the turn, the lowest slope of any receiver's horizon.
using SectorFloors = std::array<float, AzimuthRing::sectors>;

/// Of some edges, from where receivers may see them: the sectors from first to last, counted on over the end of the turn, and how
/// steep they can be at the most: 0 for those that nobody sees, `anything` for those that are too near to tell.
struct EdgeReach {
  static constexpr float anything = 1e30F;
  Floats steepest;
  Wholes first, last;
};

/// Bounds give way by this share, and azimuths by this many turns: many times the rounding of floats.
inline constexpr float reach_give = 1e-4F;
/// A packet this near to an edge, in radii, may have it anywhere around.
inline constexpr float least_radii = 1.25F;
/// An eye that moves by r turns a point at the distance d ≥ 1.25 r by at most arcsin(r/d) ≤ 1.16 r/d; a radian is at most a
/// quarter of diamond_turns.
inline constexpr float most_turned = 0.29F;

FARLOD_LANES Floats within_half_a_turn(const Floats& turns) {
  return turns > 0.5F ? turns - 1.0F : turns < -0.5F ? turns + 1.0F : turns;
}

FARLOD_LANES EdgeReach reach_of(const SkylineEdges::Batch& edges, const PacketBounds& eye) {
  const Floats ax = loaded(edges.ax.data()), ay = loaded(edges.ay.data()), az = loaded(edges.az.data());
  const Floats bx = loaded(edges.bx.data()), by = loaded(edges.by.data()), bz = loaded(edges.bz.data());
  const Floats px = ax - eye.x, py = ay - eye.y, qx = bx - eye.x, qy = by - eye.y;
  const Floats along_x = qx - px, along_y = qy - py, along_square = along_x * along_x + along_y * along_y;
  const Floats share = -(px * along_x + py * along_y) / (along_square > 0.0F ? along_square : all(1.0F));
  const Floats s = least(greatest(share, all(0.0F)), all(1.0F));
  const Floats near_x = px + s * along_x, near_y = py + s * along_y;
  const Floats distance = root(near_x * near_x + near_y * near_y);
  const float clear_m = least_radii * eye.radius;
  const Floats clear = distance - eye.radius, high = greatest(az, bz) - eye.lowest_z;
  const Floats bound = distance > clear_m ? high / (clear > 0.0F ? clear : all(1.0F)) * (1.0F + reach_give) + reach_give
                                          : all(EdgeReach::anything);
  const Floats front = greatest(eye.normal_x * ax + eye.normal_y * ay + eye.normal_z * az,
                                eye.normal_x * bx + eye.normal_y * by + eye.normal_z * bz) -
                       eye.depth;
  EdgeReach reach;
  reach.steepest = least(high, front) > 0.0F ? bound : all(0.0F);
  const Floats p_turns = diamond_turns(px, py), width = within_half_a_turn(diamond_turns(qx, qy) - p_turns);
  const Floats from = width >= 0.0F ? p_turns : p_turns + width, to = width >= 0.0F ? p_turns + width : p_turns;
  const Floats turned = most_turned * eye.radius / (distance > 0.0F ? distance : all(1.0F)) + reach_give;
  constexpr auto sectors = static_cast<float>(AzimuthRing::sectors);
  // A turn more, so that the whole part rounds down
  reach.first = truncated((from - turned + 1.0F) * sectors);
  reach.last = distance > clear_m ? truncated((to + turned + 1.0F) * sectors) : reach.first;
  return reach;
}

/// The lowest floor of the sectors from first to last. Most edges lie within three of them: no branch decides how many.
FARLOD_LANES float lowest_floor(const SectorFloors& floors, std::int32_t first, std::int32_t last) {
  const auto floor_at = [&floors](std::int32_t s) __attribute__((always_inline)) {
    return floors[static_cast<std::size_t>(s) % AzimuthRing::sectors];
  };
  const float at_ends = floor_at(first) < floor_at(last) ? floor_at(first) : floor_at(last);
  const std::int32_t second = first + 1 < last ? first + 1 : last;
  float lowest = floor_at(second) < at_ends ? floor_at(second) : at_ends;
  for (std::int32_t s = first + 2; s < last; ++s) lowest = floor_at(s) < lowest ? floor_at(s) : lowest;
  return lowest;
}

/// Writes the lanes of the edges that may rise over somebody's horizon, and returns how many there are.
FARLOD_LANES std::size_t find_risers(const EdgeReach& reach, const SectorFloors& floors,
                                     std::array<std::uint8_t, lane_count>& risers) {
  std::size_t count = 0;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const float floor = lowest_floor(floors, reach.first[l], reach.last[l]), steepest = reach.steepest[l];
    risers[count] = static_cast<std::uint8_t>(l);
    count += static_cast<std::size_t>((steepest > floor) & (steepest > 0.0F)) |
             static_cast<std::size_t>(steepest == EdgeReach::anything);
  }
  return count;
}

}  // namespace farlod
