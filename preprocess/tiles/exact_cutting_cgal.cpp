// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/exact_cutting_cgal.hpp"

#include <algorithm>
#include <utility>

namespace farlod {
namespace {

using Polygon = std::vector<ExactCorner>;
enum class Axis : std::uint8_t { x, y };

const Rational& along(Axis axis, const ExactCorner& c) { return axis == Axis::x ? c.p_grid.x : c.p_grid.y; }

/// Where the edge a–b meets the line at `border`. Exact, hence the same from either side of the edge.
ExactCorner crossing(Axis axis, const ExactCorner& a, const ExactCorner& b, const Rational& border) {
  const Rational t = (border - along(axis, a)) / (along(axis, b) - along(axis, a));
  ExactPoint p{a.p_grid.x + t * (b.p_grid.x - a.p_grid.x), a.p_grid.y + t * (b.p_grid.y - a.p_grid.y),
               a.p_grid.z + t * (b.p_grid.z - a.p_grid.z)};
  return {std::move(p), -1};
}

/// Splits a convex polygon that lies on both sides of a border into what is below and what is above.
std::pair<Polygon, Polygon> split(const Polygon& polygon, Axis axis, const Rational& border) {
  std::pair<Polygon, Polygon> parts;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ExactCorner& a = polygon[k];
    const ExactCorner& b = polygon[(k + 1) % polygon.size()];
    const auto side_a = CGAL::compare(along(axis, a), border), side_b = CGAL::compare(along(axis, b), border);
    if (side_a != CGAL::LARGER) parts.first.push_back(a);
    if (side_a != CGAL::SMALLER) parts.second.push_back(a);
    if (side_a * side_b != -1) continue;
    const ExactCorner c = crossing(axis, a, b, border);
    parts.first.push_back(c);
    parts.second.push_back(c);
  }
  return parts;
}

/// The intervals between borders that a polygon reaches into. One that lies wholly on a border belongs to the
/// interval above it; one that merely ends there does not reach it.
std::pair<std::int32_t, std::int32_t> intervals(const Polygon& polygon, Axis axis, const Grid& grid) {
  const auto less = [axis](const ExactCorner& a, const ExactCorner& b) { return along(axis, a) < along(axis, b); };
  const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), less);
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
  auto [first, last] = intervals(polygon, axis, grid);
  if (last < wanted.begin || first >= wanted.end) return;
  if (first < wanted.begin) polygon = split(polygon, axis, Rational(grid.border_m(wanted.begin))).second;
  if (last >= wanted.end) polygon = split(polygon, axis, Rational(grid.border_m(wanted.end))).first;
  first = std::max(first, wanted.begin);
  last = std::min(last, wanted.end - 1);
  for (std::int32_t k = first; k < last; ++k) {
    auto [below, above] = split(polygon, axis, Rational(grid.border_m(k + 1)));
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
  std::vector<ExactPiece> pieces;
  cut_along(Axis::x, std::move(triangle), grid, {wanted.i_begin, wanted.i_end}, [&](std::int32_t i, Polygon column) {
    cut_along(Axis::y, std::move(column), grid, {wanted.j_begin, wanted.j_end}, [&](std::int32_t j, Polygon piece) {
      pieces.push_back({{i, j}, std::move(piece)});
    });
  });
  return pieces;
}

ExactPoint twice_area_vector(const std::vector<ExactCorner>& polygon) {
  ExactPoint sum{Rational(0), Rational(0), Rational(0)};
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum = sum + cross(polygon[k - 1].p_grid - polygon[0].p_grid, polygon[k].p_grid - polygon[0].p_grid);
  return sum;
}

}  // namespace farlod
