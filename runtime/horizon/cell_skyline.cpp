// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/cell_skyline.hpp"

#include <algorithm>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

/// Offsets are added in double and rounded once, as for a scene of triangles.
Point3f moved(const Point3f& p, Point2d shift_m) {
  return {static_cast<float>(p.x + shift_m.x), static_cast<float>(p.y + shift_m.y), p.z};
}

void add(const HorizonEdge& edge, Point2d shift_m, CellSkyline& skyline, OverhangEdges& overhangs) {
  const HorizonEdge placed{moved(edge.a, shift_m), moved(edge.b, shift_m), edge.rises, edge.role};
  switch (edge.role) {
    case EdgeRole::grounded:
      return skyline.grounded.add(placed);
    case EdgeRole::overhang:
      return overhangs.upper.add(placed);
    case EdgeRole::underside:
      return overhangs.lower.add(placed);
  }
}

void keep_facing(OverhangEdges& edges, const ReceiverBox& box) {
  edges.upper = edges.upper.facing(box);
  edges.lower = edges.lower.facing(box);
}

}  // namespace

CellSkyline cell_skyline(const Package& package, Cell cell, const FarHorizon& far, const ReceiverBox& box) {
  CellSkyline skyline;
  const Grid& grid = package.grid();
  // The most part of what is seen is far
  skyline.grounded.reserve(2 * far.named.named_edges.size());
  const CellRange near = grid.neighborhood_of(cell).intersection(grid.cells);
  for (std::size_t n = 0; n < static_cast<std::size_t>(near.size()); ++n) {
    const Cell neighbour = near.cell_at(n);
    const Point2d shift_m = grid.corner_of(neighbour) - grid.corner_of(cell);
    package.tile(neighbour).visit_edges([&](const HorizonEdge& e) { add(e, shift_m, skyline, skyline.near); });
  }
  const std::uint32_t layers = far.layers_met_from(box.low.z, box.high.z);
  for (const package::NamedObstacle& n : far.named.named_edges)
    if ((n.layers & layers) != 0) add(far.named.edges[n.row], far.named.cell_from_block_m, skyline, skyline.far);
  skyline.grounded = skyline.grounded.facing(box);
  keep_facing(skyline.near, box);
  keep_facing(skyline.far, box);
  return skyline;
}

ReceiverBox box_around(std::span<const Receiver> receivers) {
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
