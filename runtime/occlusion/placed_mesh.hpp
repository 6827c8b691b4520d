// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "base/grid.hpp"
#include "base/mesh_view.hpp"
#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// A tile's mesh, and where its corner lies in the frame of a scene.
struct PlacedMesh {
  MeshView mesh;
  Point2d corner_m;
};

/// An occluder, and the place of its frame: added to a place of the cell frame, gives one of the occluder's.
struct PlacedScene {
  const Occluder& occluder;
  Point2d scene_from_cell_m;
};

/// A place of a tile in the frame of a scene. The offset is added in double and rounded once, so that what touches across a
/// border of cells still touches: docs/concepts.md, "Why a border has no gap".
[[nodiscard]] inline Point3f placed(const Point3f& p, Point2d corner_m) {
  return {static_cast<float>(p.x + corner_m.x), static_cast<float>(p.y + corner_m.y), p.z};
}

/// One occluder of many tiles, each `placed`. Triangles are numbered through, in the order given.
/// Throws LimitReached where there are more than 32 bits can number.
[[nodiscard]] Occluder occluder_of(std::span<const PlacedMesh> tiles, const std::stop_token& stop = {});

/// One occluder of the tiles of some cells, in the order of the range, and of a mesh in the frame of the occluder after them. The
/// frame is the grid frame, moved to `origin_grid`.
[[nodiscard]] Occluder occluder_of_cells(const Grid& grid, const CellRange& cells, Point2d origin_grid,
                                         const std::function<MeshView(Cell)>& mesh_of, const std::stop_token& stop = {},
                                         const MeshView& beyond = {});

}  // namespace farlod
