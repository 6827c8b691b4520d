// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "city/geometry.hpp"
#include "tiles/cutting.hpp"
#include "tiles/exact_cutting_cgal.hpp"

namespace farlod::tiles {
namespace {

enum class Axis : std::uint8_t { x, y };

/// Bounds do not tell on which side of a border a corner lies, or to which float it is rounded. Leaves this file never.
class Uncertain : public std::runtime_error {
 public:
  Uncertain() : std::runtime_error("the bounds of a number are too wide") {}
};

/// The part of a triangle within a square has at most seven corners, and one more while it is cut.
constexpr std::size_t most_corners = 8;

using ExactPolygon = std::vector<ExactCorner>;

struct BoundedCorner {
  using Number = BoundedNumber;
  Point3<BoundedNumber> p_grid;
  std::int8_t original = -1;
};

using BoundedPolygon = SmallPolygon<BoundedCorner, most_corners>;

double approximate(const Rational& x) { return CGAL::to_double(x); }
double approximate(const BoundedNumber& x) { return x.value(); }

CGAL::Comparison_result compare(const Rational& x, double border) { return CGAL::compare(x, Rational(border)); }

/// Throws Uncertain.
CGAL::Comparison_result compare(const BoundedNumber& x, double border) {
  const BoundedNumber beyond = x - border;
  if (!beyond.is_exact() && !(std::abs(beyond.value()) > beyond.error())) throw Uncertain();
  return CGAL::compare(beyond.value(), 0.0);
}

template <class Corner>
const auto& along(Axis axis, const Corner& c) {
  return axis == Axis::x ? c.p_grid.x : c.p_grid.y;
}

/// The point at which the edge a–b crosses the line at `border`. It is exact, hence the same for both triangles of the edge.
template <class Corner>
Corner crossing(Axis axis, const Corner& a, const Corner& b, double border) {
  using Number = typename Corner::Number;
  // t = (border − a) / (b − a), p = a + t·(b − a); along the axis, that is the border itself
  const Number t = (Number(border) - along(axis, a)) / (along(axis, b) - along(axis, a));
  const auto at = [&t](const Number& from, const Number& to) { return Number(from + t * (to - from)); };
  const auto &p = a.p_grid, &q = b.p_grid;
  if (axis == Axis::x) return {{Number(border), at(p.y, q.y), at(p.z, q.z)}, -1};
  return {{at(p.x, q.x), Number(border), at(p.z, q.z)}, -1};
}

/// Splits a convex polygon that lies on both sides of a border into the part below and the part above (Sutherland and Hodgman
/// 1974).
template <class Polygon>
std::pair<Polygon, Polygon> split(Polygon polygon, Axis axis, double border) {
  // Find the sides of all corners first: a corner that is moved into a part cannot be asked any more
  FARLOD_EXPECTS(polygon.size() <= most_corners);
  std::array<CGAL::Comparison_result, most_corners> sides;
  for (std::size_t k = 0; k < polygon.size(); ++k) sides[k] = compare(along(axis, polygon[k]), border);
  // Each edge from a corner to the next that crosses the border ends one part and begins the other, at the same point
  std::array<std::optional<typename Polygon::value_type>, most_corners> crossings;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (sides[k] * sides[next] == -1) crossings[k] = crossing(axis, polygon[k], polygon[next], border);
  }
  // Walk round the polygon. Numbers of arbitrary length are moved, for each copy of one asks for memory
  std::pair<Polygon, Polygon> parts;
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

/// The interval between borders that a coordinate lies in.
template <class Number>
std::int32_t interval_of(const Number& x, const Grid& grid) {
  // Estimate the interval in double precision, then correct it
  std::int32_t k = grid.interval_of(approximate(x));
  while (compare(x, grid.border_m(k)) == CGAL::SMALLER) --k;
  while (compare(x, grid.border_m(k + 1)) != CGAL::SMALLER) ++k;
  return k;
}

/// The first and the last interval between borders that a polygon reaches into. A polygon that lies wholly on a border belongs to
/// the interval above the border. A polygon that only ends there does not reach into that interval.
template <class Polygon>
std::pair<std::int32_t, std::int32_t> intervals(const Polygon& polygon, Axis axis, const Grid& grid) {
  std::int32_t first = std::numeric_limits<std::int32_t>::max(), last = std::numeric_limits<std::int32_t>::min();
  for (const auto& corner : polygon) {
    const auto& x = along(axis, corner);
    const std::int32_t k = interval_of(x, grid);
    first = std::min(first, k);
    last = std::max(last, compare(x, grid.border_m(k)) == CGAL::EQUAL ? k - 1 : k);
  }
  return {first, std::max(first, last)};
}

/// Intervals from `begin` to before `end`.
struct Wanted {
  std::int32_t begin, end;
};

/// Cuts along the borders of one axis, and hands each part that is wanted on with its interval.
template <class Polygon, class Sink>
void cut_along(Axis axis, Polygon polygon, const Grid& grid, Wanted wanted, const Sink& sink) {
  // Clip the polygon to the wanted range first: no time is spent on cells that nobody wants
  auto [first, last] = intervals(polygon, axis, grid);
  if (last < wanted.begin || first >= wanted.end) return;
  if (first < wanted.begin) polygon = split(std::move(polygon), axis, grid.border_m(wanted.begin)).second;
  if (last >= wanted.end) polygon = split(std::move(polygon), axis, grid.border_m(wanted.end)).first;
  first = std::max(first, wanted.begin);
  last = std::min(last, wanted.end - 1);
  // Cut off one interval after the other, from low to high
  for (std::int32_t k = first; k < last; ++k) {
    auto [below, above] = split(std::move(polygon), axis, grid.border_m(k + 1));
    sink(k, std::move(below));
    polygon = std::move(above);
  }
  sink(last, std::move(polygon));
}

/// Cuts a triangle into columns along x, and each column into cells along y. Hands each piece on with its cell.
template <class Polygon, class Sink>
void cut_into_cells(const std::array<Point3d, 3>& triangle_grid, const Grid& grid, const CellRange& wanted, const Sink& sink) {
  using Number = typename Polygon::value_type::Number;
  Polygon triangle;
  for (std::int8_t n = 0; n < 3; ++n) {
    const Point3d& p = triangle_grid[static_cast<std::size_t>(n)];
    triangle.push_back({{Number(p.x), Number(p.y), Number(p.z)}, n});
  }
  cut_along(Axis::x, std::move(triangle), grid, {wanted.i_begin, wanted.i_end}, [&](std::int32_t i, Polygon column) {
    cut_along(Axis::y, std::move(column), grid, {wanted.j_begin, wanted.j_end}, [&](std::int32_t j, Polygon piece) {
      sink(Cell{i, j}, std::move(piece));
    });
  });
}

/// The cell that contains the whole triangle, if there is one.
std::optional<Cell> cell_of_all(const std::array<Point3d, 3>& t, const Grid& grid) {
  const Cell low = grid.cell_of({std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y})});
  const Cell high = grid.cell_of({std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y})});
  return low == high ? std::optional(low) : std::nullopt;
}

float rounded(const Rational& exact, double origin) { return static_cast<float>(CGAL::to_double(exact - Rational(origin))); }

/// What the exact number would be rounded to: that to which all numbers within the bounds are. Throws Uncertain.
float rounded(const BoundedNumber& x, double origin) {
  const BoundedNumber shifted = x - origin;
  // −0 is no rational number
  if (shifted.is_exact()) return static_cast<float>(shifted.value() + 0.0);
  const auto low = static_cast<float>(shifted.low()), high = static_cast<float>(shifted.high());
  // Near 0, the sign of a zero would be unknown
  if (!(low == high) || low == 0.0F) throw Uncertain();
  return low;
}

template <class Corner>
Point3f rounded(const Corner& corner, const std::array<Point3d, 3>& triangle, Cell cell, const Grid& grid,
                double height_origin_m) {
  // A corner of the triangle is rounded as in a triangle that was never cut
  if (corner.original >= 0)
    return cell_from_grid(triangle[static_cast<std::size_t>(corner.original)], cell, grid, height_origin_m);
  // A corner that the cut made is rounded once, after the exact subtraction of the cell's corner
  const Point2d south_west = grid.corner_of(cell);
  return {rounded(corner.p_grid.x, south_west.x), rounded(corner.p_grid.y, south_west.y),
          rounded(corner.p_grid.z, height_origin_m)};
}

CellPiece whole_triangle(const std::array<Point3d, 3>& triangle, Cell cell, const Grid& grid, double height_origin_m) {
  CellPiece piece{cell, {}};
  for (const Point3d& p : triangle) piece.polygon.push_back(cell_from_grid(p, cell, grid, height_origin_m));
  return piece;
}

/// Throws Uncertain where the numbers of the polygons are bounded, and do not tell all.
template <class Polygon>
void cut_and_round(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m, const CellRange& wanted,
                   std::vector<CellPiece>& pieces) {
  cut_into_cells<Polygon>(triangle, grid, wanted, [&](Cell cell, const Polygon& polygon) {
    CellPiece& piece = pieces.emplace_back(CellPiece{cell, {}});
    for (const auto& corner : polygon) piece.polygon.push_back(rounded(corner, triangle, cell, grid, height_origin_m));
  });
}

void cut(const std::array<Point3d, 3>& triangle, const Grid& grid, double height_origin_m, const CellRange& wanted,
         std::vector<CellPiece>& pieces) {
  // A triangle inside one cell needs no arithmetic
  if (const auto cell = cell_of_all(triangle, grid)) {
    if (wanted.contains(*cell)) pieces.push_back(whole_triangle(triangle, *cell, grid, height_origin_m));
    return;
  }
  // As a rule, bounds tell to which floats the exact corners are rounded
  const std::size_t known = pieces.size();
  try {
    cut_and_round<BoundedPolygon>(triangle, grid, height_origin_m, wanted, pieces);
  } catch (const Uncertain&) {
    pieces.resize(known);
    cut_and_round<ExactPolygon>(triangle, grid, height_origin_m, wanted, pieces);
  }
}

}  // namespace

std::vector<ExactPiece> cut_exactly(const std::array<Point3d, 3>& triangle_grid, const Grid& grid, const CellRange& wanted) {
  std::vector<ExactPiece> pieces;
  cut_into_cells<ExactPolygon>(triangle_grid, grid, wanted, [&](Cell cell, ExactPolygon piece) {
    pieces.push_back({cell, std::move(piece)});
  });
  return pieces;
}

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

double area_of(const CellPolygon& convex) {
  double area_m2 = 0.0;
  for (std::size_t n = 2; n < convex.size(); ++n) area_m2 += 0.5 * norm(cross(convex[n - 1] - convex[0], convex[n] - convex[0]));
  return area_m2;
}

}  // namespace farlod::tiles
