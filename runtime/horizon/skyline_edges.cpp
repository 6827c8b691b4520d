// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/skyline_edges.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "farlod/horizon/edge_facing.hpp"
#include "farlod/horizon/edge_view.hpp"

namespace farlod {

SkylineEdges SkylineEdges::facing(const ReceiverBox& box) const {
  const auto place = [](const Point3f& p) { return Point3d{p.x, p.y, p.z}; };
  const Box2d plan{{box.low.x, box.low.y}, {box.high.x, box.high.y}};
  const Point2d middle = 0.5 * (plan.low + plan.high);
  std::vector<std::pair<double, std::size_t>> from_near_to_far;
  for (std::size_t n = 0; n < size(); ++n) {
    const HorizonEdge e = at(n);
    const Point3d a = place(e.a), b = place(e.b);
    if (std::max(a.z, b.z) <= box.low.z || !may_be_horizon(a, b, e.rises, plan, box.low.z, box.high.z)) continue;
    from_near_to_far.emplace_back(distance_to_segment(horizontal(a) - middle, horizontal(b) - middle), n);
  }
  std::sort(from_near_to_far.begin(), from_near_to_far.end());
  SkylineEdges result;
  for (const auto& [distance, n] : from_near_to_far) result.add(at(n));
  return result;
}

}  // namespace farlod
