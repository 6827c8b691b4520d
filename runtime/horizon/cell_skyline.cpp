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

void add(const HorizonEdge& edge, Point2d shift_m, CellSkyline& skyline) {
  const HorizonEdge placed{moved(edge.a, shift_m), moved(edge.b, shift_m), edge.rises, edge.role};
  switch (edge.role) {
    case EdgeRole::grounded:
      return skyline.grounded.add(placed);
    case EdgeRole::overhang:
      return skyline.overhangs.add(placed);
    case EdgeRole::underside:
      return skyline.undersides.add(placed);
  }
}

void add_named(const NamedObstacles& named, std::uint32_t layers, CellSkyline& skyline) {
  for (const package::NamedObstacle& n : named.named_edges)
    if ((n.layers & layers) != 0) add(named.edges[n.row], named.cell_from_block_m, skyline);
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
    package.tile(neighbour).visit_edges([&](const HorizonEdge& e) { add(e, shift_m, skyline); });
  }
  add_named(far.named, far.layers_met_from(box.low.z, box.high.z), skyline);
  skyline.grounded = skyline.grounded.facing(box, EdgeRole::grounded);
  skyline.overhangs = skyline.overhangs.facing(box, EdgeRole::overhang);
  skyline.undersides = skyline.undersides.facing(box, EdgeRole::underside);
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
