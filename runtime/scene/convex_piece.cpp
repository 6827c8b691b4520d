// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/convex_piece.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace farlod {
namespace {

bool is_negligible(const ConvexPiece& piece) { return !(norm(area_vector(piece)) > negligible_area_m2); }

/// The plane through a side, whose ends are taken in one order, whichever way the side runs.
HalfSpace beside(Point3d a, Point3d b, const Point3d& direction, const Point3d& third) {
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
  const HalfSpace side{a, cross(b - a, direction)};
  return side.signed_distance(third) < 0.0 ? side.opposite() : side;
}

/// Adds the part that is not in a half space. A piece that lies in its plane is.
void add_part_outside(const ConvexPiece& piece, const HalfSpace& side, std::vector<ConvexPiece>& pieces) {
  if (std::ranges::all_of(piece, [&](const Point3d& p) { return side.signed_distance(p) >= 0.0; })) return;
  ConvexPiece part = part_in(piece, side.opposite());
  if (!is_negligible(part)) pieces.push_back(std::move(part));
}

}  // namespace

Point3d area_vector(const ConvexPiece& piece) {
  Point3d twice;
  for (std::size_t n = 2; n < piece.size(); ++n) twice = twice + cross(piece[n - 1] - piece[0], piece[n] - piece[0]);
  return 0.5 * twice;
}

ConvexPiece part_in(const ConvexPiece& piece, const HalfSpace& side) {
  ConvexPiece part;
  for (std::size_t n = 0; n < piece.size(); ++n) {
    const Point3d &a = piece[n], &b = piece[(n + 1) % piece.size()];
    const double at_a = side.signed_distance(a), at_b = side.signed_distance(b);
    if (at_a >= 0.0) part.push_back(a);
    if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0)) part.push_back(a + (at_a / (at_a - at_b)) * (b - a));
  }
  return part.size() < 3 ? ConvexPiece() : part;
}

Column::Column(const FlatTriangle& triangle, const Point3d& direction)
    : sides{beside(triangle[0], triangle[1], direction, triangle[2]), beside(triangle[1], triangle[2], direction, triangle[0]),
            beside(triangle[2], triangle[0], direction, triangle[1])} {}

ConvexPiece Column::part_of(const ConvexPiece& piece) const {
  ConvexPiece part = piece;
  for (const HalfSpace& side : sides) part = part_in(part, side);
  return part;
}

std::vector<ConvexPiece> without(const std::vector<ConvexPiece>& pieces, const Column& column, const HalfSpace& beyond) {
  std::vector<ConvexPiece> left;
  for (const ConvexPiece& piece : pieces) {
    if (is_negligible(part_in(column.part_of(piece), beyond))) {
      left.push_back(piece);
      continue;
    }
    ConvexPiece rest = piece;
    for (const HalfSpace& side : column.sides) {
      add_part_outside(rest, side, left);
      rest = part_in(rest, side);
    }
    add_part_outside(rest, beyond, left);
  }
  return left;
}

}  // namespace farlod
