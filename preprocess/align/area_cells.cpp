// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "align/area_cells.hpp"

#include <algorithm>
#include <utility>

namespace farlod::align {
namespace {

/// A range of numbers, closed.
struct Range {
  double low, high;

  [[nodiscard]] Range within(const Range& o) const { return {std::max(low, o.low), std::min(high, o.high)}; }
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

Range range_of(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

/// Marks cells of a grid. All coordinates are in the grid frame.
class CellMarker {
 public:
  explicit CellMarker(const Grid& grid)
      : grid_(grid), is_met_(static_cast<std::size_t>(grid.cells.size()), false), rectangle_(grid.rectangle()) {}

  /// Returns whether the shape meets a cell, as do the other two.
  bool mark_point(Point2d p) {
    if (!rectangle_.contains(p)) return false;
    return mark(grid_.cell_of(p));
  }
  bool mark_line(const Area::Line& line) {
    // A line of a single point is that point
    bool any = line.size() == 1 && mark_point(line.front());
    for (std::size_t k = 1; k < line.size(); ++k) any |= mark_segment(line[k - 1], line[k]);
    return any;
  }
  bool mark_polygon(const Area::Polygon& polygon) {
    bool any = false;
    for (const Area::Line& ring : polygon) {
      any |= mark_line(ring);
      if (!ring.empty()) any |= mark_segment(ring.back(), ring.front());
    }
    // No ring runs through any other cell: it is covered whole where its centre is
    for (std::int32_t j = grid_.cells.j_begin; j < grid_.cells.j_end; ++j) any |= mark_covered(polygon, j);
    return any;
  }
  [[nodiscard]] std::vector<Cell> marked() const {
    std::vector<Cell> cells;
    for (std::size_t n = 0; n < is_met_.size(); ++n)
      if (is_met_[n]) cells.push_back(grid_.cells.cell_at(n));
    return cells;
  }

 private:
  bool mark(Cell cell) {
    // The rectangle is closed at its east and north, cells are not
    if (!grid_.cells.contains(cell)) return false;
    is_met_[grid_.cells.index_of(cell)] = true;
    return true;
  }

  bool mark_segment(Point2d a, Point2d b) {
    const Range y = range_of(a.y, b.y).within({rectangle_.low.y, rectangle_.high.y});
    if (y.empty()) return false;
    bool any = false;
    for (std::int32_t j = grid_.interval_of(y.low); j <= grid_.interval_of(y.high); ++j) {
      const Range in_row = y.within({grid_.border_m(j), grid_.border_m(j + 1)});
      any |= mark_row(j, a.y == b.y ? range_of(a.x, b.x) : range_of(x_at(in_row.low, a, b), x_at(in_row.high, a, b)));
    }
    return any;
  }
  bool mark_row(std::int32_t j, const Range& of_segment) {
    const Range x = of_segment.within({rectangle_.low.x, rectangle_.high.x});
    bool any = false;
    if (x.empty()) return any;
    for (std::int32_t i = grid_.interval_of(x.low); i <= grid_.interval_of(x.high); ++i) any |= mark({i, j});
    return any;
  }
  static double x_at(double y, Point2d a, Point2d b) {
    return std::clamp(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)), std::min(a.x, b.x), std::max(a.x, b.x));
  }

  /// Marks the cells of a row whose centres lie within the polygon.
  bool mark_covered(const Area::Polygon& polygon, std::int32_t j) {
    const double y = grid_.centre_of({0, j}).y;
    std::vector<double> crossings;
    for (const Area::Line& ring : polygon)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point2d a = ring[k], b = ring[(k + 1) % ring.size()];
        if ((a.y <= y) != (b.y <= y)) crossings.push_back(x_at(y, a, b));
      }
    std::sort(crossings.begin(), crossings.end());
    bool any = false;
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) any |= mark_centres(j, {crossings[k], crossings[k + 1]});
    return any;
  }
  bool mark_centres(std::int32_t j, const Range& between) {
    const Range x = between.within({rectangle_.low.x, rectangle_.high.x});
    bool any = false;
    if (x.empty()) return any;
    for (std::int32_t i = grid_.interval_of(x.low); i <= grid_.interval_of(x.high); ++i) {
      const double centre = grid_.centre_of({i, j}).x;
      if (x.low <= centre && centre <= x.high) any |= mark({i, j});
    }
    return any;
  }

  const Grid& grid_;
  std::vector<bool> is_met_;
  Box2d rectangle_;
};

}  // namespace

AreaCells cells_met_by(const Area& area_city, const Grid& grid) {
  Area area = area_city;
  area.for_each_point([&](Point2d& p) { p = grid.rotation.grid_from_city(p); });
  CellMarker marker(grid);
  std::size_t met = 0;
  for (const Point2d p : area.points) met += marker.mark_point(p) ? 1 : 0;
  for (const Area::Line& line : area.lines) met += marker.mark_line(line) ? 1 : 0;
  for (const Area::Polygon& polygon : area.polygons) met += marker.mark_polygon(polygon) ? 1 : 0;
  return {marker.marked(), area.shape_count() - met};
}

}  // namespace farlod::align
