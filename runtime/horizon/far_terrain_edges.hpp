// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/mesh_view.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {

/// The edges of a far terrain that can be a horizon, each once, in its own frame. Packages hold its triangles alone: far maps of
/// the cells have its edges, and only places outside of the grid have no far map.
[[nodiscard]] std::vector<HorizonEdge> horizon_edges_of(const MeshView& far_terrain);

}  // namespace farlod
