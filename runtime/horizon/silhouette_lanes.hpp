// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/horizon/edge_facing.hpp"
#include "horizon/lanes.hpp"
#include "horizon/silhouette_edges.hpp"

/// may_be_silhouette (farlod/horizon/edge_facing.hpp) for sixteen edges at once.
namespace farlod {

inline constexpr auto silhouette_slack_m = static_cast<float>(facing_slack_m);
/// Of the coordinates that go into a sum, more than the rounding of all its operations, 16 times 2^-24.
inline constexpr float silhouette_rounding = 0x1p-20F;

/// Where the eyes may be: the plan's middle and half its sides, and the heights.
struct EyeBox {
  float x, y, half_x, half_y, low_z, high_z;
};

/// Edges as the middle of the eyes sees them. What follows is as in may_be_silhouette, times the edge's horizontal length: there
/// is less to divide.
struct SeenEdges {
  Floats eye_x, eye_y;  ///< the middle, from the first end
  Floats first_z, along_x, along_y, along_z, run;
  Floats level, tilt;  ///< run and rise, as shares of the length
  Floats ahead, left;  ///< of the middle
  Floats give;         ///< the slack, and the rounding
};

FARLOD_LANES SeenEdges seen_edges(const SilhouetteEdges::Batch& e, const EyeBox& eyes) {
  SeenEdges s;
  const Floats ax = load(e.ax.data()), ay = load(e.ay.data()), bz = load(e.bz.data());
  s.first_z = load(e.az.data());
  s.along_x = load(e.bx.data()) - ax;
  s.along_y = load(e.by.data()) - ay;
  s.along_z = bz - s.first_z;
  s.eye_x = eyes.x - ax;
  s.eye_y = eyes.y - ay;
  const Floats run_square = s.along_x * s.along_x + s.along_y * s.along_y;
  s.run = sqrt(run_square);
  const Floats length = max(sqrt(run_square + s.along_z * s.along_z), broadcast(1e-12F));
  s.level = s.run / length;
  s.tilt = s.along_z / length;
  s.ahead = s.along_x * s.eye_x + s.along_y * s.eye_y;
  s.left = s.along_x * s.eye_y - s.along_y * s.eye_x;
  const Floats coordinates = abs(s.eye_x) + abs(s.eye_y) + (eyes.half_x + eyes.half_y) +
                             abs(eyes.low_z - s.first_z) + abs(eyes.high_z - s.first_z) + abs(s.along_z);
  s.give = s.run * (silhouette_slack_m + silhouette_rounding * coordinates);
  return s;
}

/// Over the box, the most of `sign` times the rise over the edge of an eye at the height z, less the rise of a facet of this
/// slope below or above the eye. All eyes are on one side.
FARLOD_LANES Floats most_over(const SeenEdges& s, const EyeBox& eyes, float sign, const Floats& z, const Floats& slope) {
  const Floats rise = (z - s.first_z) * s.run * s.level - s.ahead * s.tilt;
  const Floats towards_left = s.left > 0.0F ? slope : -slope, tilt = sign * s.tilt;
  const Floats per_x = towards_left * s.along_y - tilt * s.along_x, per_y = -towards_left * s.along_x - tilt * s.along_y;
  return sign * rise - s.left * towards_left + abs(per_x) * eyes.half_x + abs(per_y) * eyes.half_y +
         s.give * (1.0F + abs(slope));
}

/// More than 0 for the edges that may be a silhouette. A lower border is an upper one upside down.
FARLOD_LANES Floats may_be_silhouette(const SeenEdges& s, const SilhouetteEdges::Batch& e, const EyeBox& eyes, bool is_upper) {
  const Floats left = load(e.left.data()), right = load(e.right.data());
  const Floats near_slope = s.left > 0.0F ? left : right, far_slope = s.left > 0.0F ? right : left;
  const Floats below_edge = s.first_z + max(s.along_z, broadcast(0.0F)) - 2.0F * silhouette_slack_m;
  const Floats highest = min(broadcast(eyes.high_z), below_edge), lowest = broadcast(eyes.low_z);
  const Floats past_near =
      is_upper ? most_over(s, eyes, 1.0F, highest, near_slope) : most_over(s, eyes, -1.0F, lowest, -near_slope);
  const Floats past_far = is_upper ? most_over(s, eyes, -1.0F, lowest, far_slope) : most_over(s, eyes, 1.0F, highest, -far_slope);
  const Floats aside = abs(s.left) - abs(s.along_y) * eyes.half_x - abs(s.along_x) * eyes.half_y;
  // Eyes on both sides, or an upright edge: it has none
  return aside > s.give ? min(past_near, past_far) : broadcast(1.0F);
}

}  // namespace farlod
