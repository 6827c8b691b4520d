// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "farlod/grid.hpp"
#include "farlod/mesh_view.hpp"
#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// A tile's mesh, and where its corner lies in the frame of a scene.
struct PlacedMesh {
  MeshView mesh;
  Point2d corner_m;
};

/// One occluder of many tiles. Triangles are numbered through, in the order given.
/// Offsets are added in double and rounded once, so that what touches across a border still touches.
[[nodiscard]] Occluder occluder_of(std::span<const PlacedMesh> tiles);

/// One occluder of the tiles of some cells, in the order of the range. Its frame is the grid frame, moved to `origin_grid`.
[[nodiscard]] Occluder occluder_of_cells(const Grid& grid, const CellRange& cells, Point2d origin_grid,
                                         const std::function<MeshView(Cell)>& mesh_of);

}  // namespace farlod
