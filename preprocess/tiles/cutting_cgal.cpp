// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "tiles/cutting.hpp"
#include "tiles/exact_cutting_cgal.hpp"

namespace farlod::tiles {
namespace {

using Polygon = std::vector<ExactCorner>;
enum class Axis : std::uint8_t { x, y };

const Rational& along(Axis axis, const ExactCorner& c) { return axis == Axis::x ? c.p_grid.x : c.p_grid.y; }

/// The point at which the edge a–b crosses the line at `border`. It is exact, hence the same for both triangles of the edge.
ExactCorner crossing(Axis axis, const ExactCorner& a, const ExactCorner& b, const Rational& border) {
  // t = (border − a) / (b − a), p = a + t·(b − a); along the axis, that is the border itself
  const Rational t = (border - along(axis, a)) / (along(axis, b) - along(axis, a));
  const auto at = [&t](const Rational& from, const Rational& to) { return Rational(from + t * (to - from)); };
  const ExactPoint &p = a.p_grid, &q = b.p_grid;
  if (axis == Axis::x) return {{border, at(p.y, q.y), at(p.z, q.z)}, -1};
  return {{at(p.x, q.x), border, at(p.z, q.z)}, -1};
}

/// Splits a convex polygon that lies on both sides of a border into the part below and the part above (Sutherland and Hodgman
/// 1974).
std::pair<Polygon, Polygon> split(Polygon polygon, Axis axis, const Rational& border) {
  // Find the sides of all corners first: a corner that is moved into a part cannot be asked any more
  std::vector<CGAL::Comparison_result> sides;
  sides.reserve(polygon.size());
  for (const ExactCorner& c : polygon) sides.push_back(CGAL::compare(along(axis, c), border));
  // Each edge from a corner to the next that crosses the border ends one part and begins the other, at the same point
  std::vector<std::optional<ExactCorner>> crossings(polygon.size());
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (sides[k] * sides[next] == -1) crossings[k] = crossing(axis, polygon[k], polygon[next], border);
  }
  // Walk round the polygon. Numbers of arbitrary length are moved, for each copy of one asks for memory
  std::pair<Polygon, Polygon> parts;
  parts.first.reserve(polygon.size() + 1);
  parts.second.reserve(polygon.size() + 1);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    // A corner on the border belongs to both parts
    if (sides[k] == CGAL::EQUAL) parts.first.push_back(polygon[k]);
    (sides[k] == CGAL::SMALLER ? parts.first : parts.second).push_back(std::move(polygon[k]));
    if (!crossings[k]) continue;
    parts.first.push_back(*crossings[k]);
    parts.second.push_back(*std::move(crossings[k]));
  }
  return parts;
}

/// The first and the last interval between borders that a polygon reaches into. A polygon that lies wholly on a border belongs to
/// the interval above the border. A polygon that only ends there does not reach into that interval.
std::pair<std::int32_t, std::int32_t> intervals(const Polygon& polygon, Axis axis, const Grid& grid) {
  const auto less = [axis](const ExactCorner& a, const ExactCorner& b) { return along(axis, a) < along(axis, b); };
  const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), less);
  // Estimate the interval in double precision, then correct it with exact comparisons
  const auto interval_of = [&grid](const Rational& x) {
    std::int32_t k = grid.interval_of(CGAL::to_double(x));
    while (Rational(grid.border_m(k)) > x) --k;
    while (Rational(grid.border_m(k + 1)) <= x) ++k;
    return k;
  };
  const std::int32_t first = interval_of(along(axis, *low));
  std::int32_t last = interval_of(along(axis, *high));
  if (last > first && along(axis, *high) == Rational(grid.border_m(last))) --last;
  return {first, last};
}

/// Intervals from `begin` to before `end`.
struct Wanted {
  std::int32_t begin, end;
};

/// Cuts along the borders of one axis, and hands each part that is wanted on with its interval.
template <class Sink>
void cut_along(Axis axis, Polygon polygon, const Grid& grid, Wanted wanted, const Sink& sink) {
  // Clip the polygon to the wanted range first: no time is spent on cells that nobody wants
  auto [first, last] = intervals(polygon, axis, grid);
  if (last < wanted.begin || first >= wanted.end) return;
  if (first < wanted.begin) polygon = split(std::move(polygon), axis, Rational(grid.border_m(wanted.begin))).second;
  if (last >= wanted.end) polygon = split(std::move(polygon), axis, Rational(grid.border_m(wanted.end))).first;
  first = std::max(first, wanted.begin);
  last = std::min(last, wanted.end - 1);
  // Cut off one interval after the other, from low to high
  for (std::int32_t k = first; k < last; ++k) {
    auto [below, above] = split(std::move(polygon), axis, Rational(grid.border_m(k + 1)));
    sink(k, std::move(below));
    polygon = std::move(above);
  }
  sink(last, std::move(polygon));
}

}  // namespace

std::vector<ExactPiece> cut_exactly(const std::array<Point3d, 3>& triangle_grid, const Grid& grid, const CellRange& wanted) {
  Polygon triangle;
  for (std::int8_t n = 0; n < 3; ++n) {
    const Point3d& p = triangle_grid[static_cast<std::size_t>(n)];
    triangle.push_back({{Rational(p.x), Rational(p.y), Rational(p.z)}, n});
  }
  // Cut into columns along x, and each column into cells along y
  std::vector<ExactPiece> pieces;
  cut_along(Axis::x, std::move(triangle), grid, {wanted.i_begin, wanted.i_end}, [&](std::int32_t i, Polygon column) {
    cut_along(Axis::y, std::move(column), grid, {wanted.j_begin, wanted.j_end}, [&](std::int32_t j, Polygon piece) {
      pieces.push_back({{i, j}, std::move(piece)});
    });
  });
  return pieces;
}

namespace {

/// The cell that contains the whole triangle, if there is one.
std::optional<Cell> cell_of_all(const std::array<Point3d, 3>& t, const Grid& grid) {
  const Cell low = grid.cell_of({std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y})});
  const Cell high = grid.cell_of({std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y})});
  return low == high ? std::optional(low) : std::nullopt;
}

Point3f rounded(const ExactCorner& corner, const std::array<Point3d, 3>& triangle, Cell cell, const Grid& grid,
                double height_origin_m) {
  // A corner of the triangle is rounded as in a triangle that was never cut
  if (corner.original >= 0)
    return cell_from_grid(triangle[static_cast<std::size_t>(corner.original)], cell, grid, height_origin_m);
  // A corner that the cut made is rounded once, after the exact subtraction of the cell's corner
  const Point2d south_west = grid.corner_of(cell);
  const auto round = [](const Rational& exact, double origin) {
    return static_cast<float>(CGAL::to_double(exact - Rational(origin)));
  };
  return {round(corner.p_grid.x, south_west.x), round(corner.p_grid.y, south_west.y), round(corner.p_grid.z, height_origin_m)};
}

CellPiece whole_triangle(const std::array<Point3d, 3>& triangle, Cell cell, const Grid& grid, double height_origin_m) {
  CellPiece piece{cell, {}};
  for (const Point3d& p : triangle) piece.polygon.push_back(cell_from_grid(p, cell, grid, height_origin_m));
  return piece;
}

void cut(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m, const CellRange& wanted,
         std::vector<CellPiece>& pieces) {
  // A triangle inside one cell needs no exact arithmetic
  if (const auto cell = cell_of_all(triangle, grid)) {
    if (wanted.contains(*cell)) pieces.push_back(whole_triangle(triangle, *cell, grid, height_origin_m));
    return;
  }
  for (const ExactPiece& exact : cut_exactly(triangle, grid, wanted)) {
    CellPiece& piece = pieces.emplace_back(CellPiece{exact.cell, {}});
    for (const ExactCorner& corner : exact.polygon)
      piece.polygon.push_back(rounded(corner, triangle, exact.cell, grid, height_origin_m));
  }
}

}  // namespace

Point3f cell_from_grid(const Point3d& p_grid, Cell cell, const Grid& grid, double height_origin_m) {
  const Point2d corner = grid.corner_of(cell);
  return {static_cast<float>(p_grid.x - corner.x), static_cast<float>(p_grid.y - corner.y),
          static_cast<float>(p_grid.z - height_origin_m)};
}

std::vector<CellPiece> cut(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m) {
  std::vector<CellPiece> pieces;
  cut(triangle, grid, height_origin_m, all_cells, pieces);
  return pieces;
}

std::vector<CellPiece> cut_unless_whole(const std::array<Point3d, 3>& triangle, const std::optional<Cell>& only_cell,
                                        const Grid& grid, double height_origin_m) {
  std::vector<CellPiece> pieces;
  cut_unless_whole(triangle, only_cell, grid, height_origin_m, pieces);
  return pieces;
}

void cut_unless_whole(const std::array<Point3d, 3>& triangle, const std::optional<Cell>& only_cell, const Grid& grid,
                      double height_origin_m, std::vector<CellPiece>& pieces) {
  if (only_cell)
    pieces.push_back(whole_triangle(triangle, *only_cell, grid, height_origin_m));
  else
    cut(triangle, grid, height_origin_m, all_cells, pieces);
}

std::vector<CellPiece> cut_within(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m) {
  std::vector<CellPiece> pieces;
  cut(triangle, grid, height_origin_m, grid.cells, pieces);
  return pieces;
}

}  // namespace farlod::tiles
