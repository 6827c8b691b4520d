// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.hpp"
#include "package/package_reader.hpp"
#include "scene/convex_piece.hpp"

namespace farlod {

/// A triangle of a tile, in the frame of a cell.
struct CellFace {
  FlatTriangle corners;  ///< counter-clockwise seen from outside
  Point3d normal;        ///< outward, of length 1
  Point3d of_surface;    ///< the same of the whole surface, however small the triangle is
  std::uint32_t building = 0;
  Point3d low, high;  ///< of the box around it
};

/// What a cell has of buildings and ground. Triangles without area are left out.
struct CellFaces {
  std::vector<CellFace> roofs, walls, ground;
  std::vector<CellFace> walls_at_border;  ///< of the cells around it, on its border
};

/// The cell must exist; buildings are cut at the borders of cells.
[[nodiscard]] CellFaces faces_of(const PackageReader& package, Cell cell);

/// Whether two boxes touch in the plan, where the first is `margin_m` larger on all sides.
[[nodiscard]] inline bool touch_in_plan(const CellFace& a, const CellFace& b, double margin_m = 0.0) {
  return a.low.x - margin_m <= b.high.x && b.low.x <= a.high.x + margin_m && a.low.y - margin_m <= b.high.y &&
         b.low.y <= a.high.y + margin_m;
}

/// Where two walls stand back to back so close to each other, they are a party wall: models round their coordinates to
/// centimetres.
inline constexpr double party_wall_m = 0.02;

}  // namespace farlod
