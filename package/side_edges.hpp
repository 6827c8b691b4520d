// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "base/mesh_view.hpp"
#include "package/horizon_edge.hpp"
#include "package/layout.hpp"
#include "package/shared_vertices.hpp"

namespace farlod {

/// The horizon edges of a tile as they are written. Nearly all are sides of its triangles. The rest was rounded elsewhere: an
/// edge is cut at the borders of cells in double precision, a triangle exactly.
struct SideEdges {
  std::vector<package::TileEdge> sides;
  std::vector<HorizonEdge> loose;
};

/// Each edge once: as the first side of `triangles` that has its ends and is no other edge, otherwise loose. An edge that runs
/// against its side is turned round.
[[nodiscard]] SideEdges side_edges(std::span<const HorizonEdge> edges, std::span<const Triangle> triangles,
                                   const SharedVertices& vertices);

}  // namespace farlod
