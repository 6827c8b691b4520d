// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "package/horizon_edge.hpp"

namespace farlod::scenes {

/// For comparing edges where neither their order nor the way they run matters: sorted, each from its lesser end.
[[nodiscard]] inline std::vector<HorizonEdge> edges_as_set(std::vector<HorizonEdge> edges) {
  const auto place = [](const Point3f& p) { return std::tie(p.x, p.y, p.z); };
  for (HorizonEdge& e : edges)
    if (place(e.b) < place(e.a)) e = {e.b, e.a, {e.adjacent.right, e.adjacent.left}, e.role};
  std::ranges::sort(edges, std::less{}, [&](const HorizonEdge& e) {
    return std::tuple(place(e.a), place(e.b), e.adjacent.left, e.adjacent.right, e.role);
  });
  return edges;
}

}  // namespace farlod::scenes
