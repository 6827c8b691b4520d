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

void add_tile(const TileView& tile, Point2d shift_m, CellSkyline& skyline) {
  const auto vertex = [&](std::uint32_t n) { return moved(tile.mesh.vertices[n], shift_m); };
  tile.visit_edges([&](const HorizonEdge& e) { skyline.standing.add({moved(e.a, shift_m), moved(e.b, shift_m), e.rises}); });
  std::uint32_t first = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    if (tile.surfaces[run.surface].stands == 0)
      for (const Triangle& t : tile.mesh.triangles.subspan(first, run.end - first))
        skyline.hanging.push_back({vertex(t.a), vertex(t.b), vertex(t.c)});
    first = run.end;
  }
}

/// What does not stand, and is named in any layer, counts in all: without it, it would be open where it is not named.
void add_named(const NamedObstacles& named, std::uint32_t layers, CellSkyline& skyline) {
  const Point2d shift_m = named.cell_from_block_m;
  for (const package::NamedObstacle& n : named.named_edges) {
    if ((n.layers & layers) == 0) continue;
    const HorizonEdge& e = named.edges[n.row];
    skyline.standing.add({moved(e.a, shift_m), moved(e.b, shift_m), e.rises});
  }
  for (const package::NamedObstacle& n : named.named_triangles) {
    const package::FarTriangle& t = named.triangles[n.row];
    skyline.hanging.push_back({moved(t[0], shift_m), moved(t[1], shift_m), moved(t[2], shift_m)});
  }
}

}  // namespace

CellSkyline cell_skyline(const Package& package, Cell cell, const FarHorizon& far, const ReceiverBox& box) {
  CellSkyline skyline;
  const Grid& grid = package.grid();
  // The most part of what is seen is far
  skyline.standing.reserve(2 * far.named.named_edges.size());
  const CellRange near = grid.neighborhood_of(cell).intersection(grid.cells);
  for (std::size_t n = 0; n < static_cast<std::size_t>(near.size()); ++n) {
    const Cell neighbour = near.cell_at(n);
    add_tile(package.tile(neighbour), grid.corner_of(neighbour) - grid.corner_of(cell), skyline);
  }
  add_named(far.named, far.layers_met_from(box.low.z, box.high.z), skyline);
  skyline.standing = skyline.standing.facing(box);
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
