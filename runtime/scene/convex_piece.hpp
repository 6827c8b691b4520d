// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// A flat convex polygon in space: what is left of a triangle after some cuts. Without corners it is empty.
using ConvexPiece = std::vector<Point3d>;
using FlatTriangle = std::array<Point3d, 3>;

/// The side of a plane to which `normal`, of any length, points.
struct HalfSpace {
  Point3d through, normal;

  [[nodiscard]] double signed_distance(const Point3d& p) const { return dot(normal, p - through); }  ///< times normal's length
  [[nodiscard]] HalfSpace opposite() const { return {through, -1.0 * normal}; }
};

/// Its area as a vector along its normal, whose length is the area; z is the area in the plan, negative where the corners run
/// clockwise seen from above.
[[nodiscard]] Point3d area_vector(const ConvexPiece& piece);

/// The part of a piece that lies in a half space. A piece and the two parts of it on the sides of a plane have the same area but
/// for rounding.
[[nodiscard]] ConvexPiece part_in(const ConvexPiece& piece, const HalfSpace& side);

/// The column that a triangle sweeps along a direction, to both sides without end.
///   (1) of two triangles that share a side, the columns along the same direction have the same plane there to the bit, so that
///       nothing lies in both or falls between
struct Column {
  std::array<HalfSpace, 3> sides;

  Column(const FlatTriangle& triangle, const Point3d& direction);
  [[nodiscard]] ConvexPiece part_of(const ConvexPiece& piece) const;
};

/// What is left of pieces without the part that lies in a column and in a half space. Parts of at most `negligible_area_m2`
/// cut nothing off, so that neighbours which only touch leave each other whole.
[[nodiscard]] std::vector<ConvexPiece> without(const std::vector<ConvexPiece>& pieces, const Column& column,
                                               const HalfSpace& beyond);
inline constexpr double negligible_area_m2 = 1e-9;

}  // namespace farlod
