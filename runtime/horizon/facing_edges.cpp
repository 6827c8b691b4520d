// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/facing_edges.hpp"

#include <algorithm>
#include <cstddef>

#include "farlod/expects.hpp"
#include "horizon/lanes.hpp"
#include "horizon/silhouette_lanes.hpp"

namespace farlod {
namespace {

static_assert(SilhouetteEdges::lanes == lane_count);

EyeBox eye_box(const ReceiverBox& b) {
  const float x = 0.5F * (b.low.x + b.high.x), y = 0.5F * (b.low.y + b.high.y);
  return {x, y, std::max(b.high.x - x, x - b.low.x), std::max(b.high.y - y, y - b.low.y), b.low.z, b.high.z};
}

FARLOD_LANES Floats distance_of(const SeenEdges& s) {
  const Floats square = s.run * s.run, share = s.ahead / (square > 0.0F ? square : broadcast(1.0F));
  const Floats nearest = min(max(share, broadcast(0.0F)), broadcast(1.0F));
  const Floats x = s.eye_x - nearest * s.along_x, y = s.eye_y - nearest * s.along_y;
  return sqrt(x * x + y * y);
}

FARLOD_FOR_EACH_PROCESSOR
void find_facing_lanes(const SilhouetteEdges::Batch& edges, const EyeBox& eyes, bool is_upper, float* distances_m) {
  const SeenEdges s = seen_edges(edges, eyes);
  const Floats highest = max(s.along_z, broadcast(0.0F)) + s.first_z;
  const Floats kept = highest > eyes.low_z ? may_be_silhouette(s, edges, eyes, is_upper) : broadcast(-1.0F);
  store(kept > 0.0F ? distance_of(s) : broadcast(-1.0F), distances_m);
}

}  // namespace

void find_facing(std::span<const SilhouetteEdges::Batch> edges, EdgeRole role, const ReceiverBox& box,
                 std::span<float> distances_m) {
  FARLOD_EXPECTS(distances_m.size() == edges.size() * lane_count);
  const EyeBox eyes = eye_box(box);
  for (std::size_t n = 0; n < edges.size(); ++n)
    find_facing_lanes(edges[n], eyes, role != EdgeRole::underside, distances_m.data() + n * lane_count);
}

}  // namespace farlod
