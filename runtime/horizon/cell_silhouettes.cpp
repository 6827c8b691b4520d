// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/cell_silhouettes.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/expects.hpp"
#include "occlusion/placed_mesh.hpp"
#include "scene/near_cells.hpp"

namespace farlod {
namespace {

HorizonEdge placed(const HorizonEdge& e, Point2d shift_m) {
  return {placed(e.a, shift_m), placed(e.b, shift_m), e.adjacent, e.role};
}

void add(const HorizonEdge& edge, CellSilhouettes& silhouettes, OverhangEdges& overhangs) {
  switch (edge.role) {
    case EdgeRole::grounded:
      return silhouettes.grounded.add(edge);
    case EdgeRole::overhang:
      return overhangs.overhangs.add(edge);
    case EdgeRole::underside:
      return overhangs.undersides.add(edge);
  }
}

/// A border over a recess has a facet that is not a wall, and lies above the eye and at most so far from it. That of an overhang
/// may be over eyes right below a wall that leans out and counts as vertical.
bool may_be_over_recess(const HorizonEdge& e, const ReceiverBox& eyes) {
  constexpr std::int8_t wall = AdjacentSlopes::straight_down;
  constexpr auto reach_m = static_cast<float>(1.1 * most_recess_depth_m);
  const bool has_left_wall = e.adjacent.left == wall, has_right_wall = e.adjacent.right == wall;
  if (e.role == EdgeRole::underside || (has_left_wall && has_right_wall)) return false;
  if (e.role == EdgeRole::overhang && !has_left_wall && !has_right_wall) return false;
  const auto is_near = [](float a, float b, float low, float high) {
    return std::min(a, b) <= high + reach_m && std::max(a, b) >= low - reach_m;
  };
  return std::max(e.a.z, e.b.z) > eyes.low.z && is_near(e.a.x, e.b.x, eyes.low.x, eyes.high.x) &&
         is_near(e.a.y, e.b.y, eyes.low.y, eyes.high.y);
}

void keep_facing(OverhangEdges& edges, const ReceiverBox& box) {
  edges.overhangs = edges.overhangs.facing(box);
  edges.undersides = edges.undersides.facing(box);
}

}  // namespace

CellSilhouettes cell_silhouettes(const PackageReader& package, Cell cell, const FarHorizon& far, const ReceiverBox& box,
                                 std::span<const HorizonEdge> far_terrain) {
  CellSilhouettes silhouettes;
  const Grid& grid = package.grid();
  // Most edges are far
  silhouettes.grounded.reserve(2 * far.occluders.explicit_edges.size());
  // Near: the edges of all tiles nearby
  const CellRange near = near_cells_of(grid, cell);
  for (std::size_t n = 0; n < static_cast<std::size_t>(near.size()); ++n) {
    const Cell neighbor = near.cell_at(n);
    const Point2d shift_m = grid.corner_of(neighbor) - grid.corner_of(cell);
    package.tile(neighbor).visit_edges([&](const HorizonEdge& e) {
      const HorizonEdge in_cell = placed(e, shift_m);
      add(in_cell, silhouettes, silhouettes.near);
      if (may_be_over_recess(in_cell, box)) silhouettes.over_recesses.push_back(in_cell);
    });
  }
  // Far: the explicit edges that matter in the receivers' layers. Their squares do not count: farlod-pack makes one square a
  // cell, and an explicit edge drawn in another square hides what the city hides there too
  const std::uint32_t layers = far.layers_met_from(box.low.z, box.high.z);
  for (const package::ExplicitOccluder& n : far.occluders.explicit_edges)
    if ((n.layers & layers) != 0)
      add(placed(far.occluders.edges[n.row], far.occluders.cell_from_block_m), silhouettes, silhouettes.far);
  const Point2d far_terrain_shift_m = grid.middle_corner() - grid.corner_of(cell);
  for (const HorizonEdge& e : far_terrain) silhouettes.grounded.add(placed(e, far_terrain_shift_m));
  // Leave out what faces away, and sort from near to far
  silhouettes.grounded = silhouettes.grounded.facing(box);
  keep_facing(silhouettes.near, box);
  keep_facing(silhouettes.far, box);
  silhouettes.number_borders();
  return silhouettes;
}

void CellSilhouettes::number_borders() {
  const std::array<SilhouetteEdges*, 3> lists{&grounded, &near.overhangs, &far.overhangs};
  std::size_t first = 0;
  for (SilhouetteEdges* edges : lists) {
    edges->number_from(static_cast<std::int32_t>(first));
    first += edges->size();
  }
  far.undersides.number_from(static_cast<std::int32_t>(near.undersides.size()));
  upper_ends = BorderEnds(std::array<const SilhouetteEdges*, 3>{lists[0], lists[1], lists[2]});
}

ReceiverBox bounding_box(std::span<const Receiver> receivers) {
  FARLOD_EXPECTS(!receivers.empty());
  ReceiverBox box{receivers[0].p_cell, receivers[0].p_cell};
  for (const Receiver& r : receivers) {
    const Point3f& p = r.p_cell;
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

}  // namespace farlod
