// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/far_terrain_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include "package/upper_facets.hpp"

namespace farlod {
namespace {

/// An edge of a triangle by the numbers of its ends, and the triangle's third corner.
struct SideOfTriangle {
  std::uint32_t first, second, opposite;
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> edge() const { return {first, second}; }
};

std::vector<SideOfTriangle> sides_by_edge(const MeshView& mesh) {
  std::vector<SideOfTriangle> sides;
  sides.reserve(3 * mesh.triangles.size());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t opposite) {
    sides.push_back({std::min(a, b), std::max(a, b), opposite});
  };
  for (const Triangle& t : mesh.triangles) {
    add(t.a, t.b, t.c);
    add(t.b, t.c, t.a);
    add(t.c, t.a, t.b);
  }
  std::ranges::sort(sides, {}, [](const SideOfTriangle& s) { return std::tuple(s.first, s.second, s.opposite); });
  return sides;
}

}  // namespace

std::vector<HorizonEdge> horizon_edges_of(const MeshView& far_terrain) {
  const auto corner = [&](std::uint32_t v) {
    const Point3f& p = far_terrain.vertices[v];
    return Point3d{p.x, p.y, p.z};
  };
  const std::vector<SideOfTriangle> sides = sides_by_edge(far_terrain);
  std::vector<HorizonEdge> edges;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    UpperFacets facets;
    const Point3d a = corner(sides[begin].first), b = corner(sides[begin].second);
    for (end = begin; end < sides.size() && sides[end].edge() == sides[begin].edge(); ++end)
      facets.add(a, b, corner(sides[end].opposite));
    if (facets.can_be_horizon(a, b))
      edges.push_back({far_terrain.vertices[sides[begin].first], far_terrain.vertices[sides[begin].second], facets.adjacent(),
                       EdgeRole::grounded});
  }
  return edges;
}

}  // namespace farlod
