// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_rational.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/grid.hpp"
#include "farlod/point.hpp"

// Private to the wrappers of CGAL and to their tests: the only header of this stage that names its number type.

namespace farlod::tiles {

using Rational = CGAL::Exact_rational;
using ExactPoint = Point3<Rational>;

/// A corner of a piece. Corners that the cut did not make remember which corner of the triangle they are, so that they can be
/// rounded as in a triangle that was never cut.
struct ExactCorner {
  using Number = Rational;
  ExactPoint p_grid;
  std::int8_t original = -1;
};

/// Whatever cells a triangle reaches.
inline constexpr CellRange all_cells{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min(),
                                     std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};

/// A convex part of a triangle, in one cell.
struct ExactPiece {
  Cell cell;
  std::vector<ExactCorner> polygon;
};

/// Cuts a triangle of the grid frame along the borders of the grid, in rational arithmetic:
///   (1) each piece lies in the closed square of its cell
///   (2) the exact area vectors of the pieces sum to the triangle's own: equality, not tolerance
///   (3) a piece on a border belongs to one cell, the one to its east or north
///   (4) two triangles that share an edge are cut at the same points of it
/// Only pieces in the cells `wanted` are returned, and time is spent on no others.
[[nodiscard]] std::vector<ExactPiece> cut_exactly(const std::array<Point3d, 3>& triangle_grid, const Grid& grid,
                                                  const CellRange& wanted = all_cells);

}  // namespace farlod::tiles
