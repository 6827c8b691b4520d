// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/canopy_around.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "base/expects.hpp"
#include "farlod/box.hpp"

namespace farlod {
namespace {

using package::CrownCellRecord;

/// The distance of a coordinate from the interval 0 to `edge_m`.
double distance_to_interval_m(double x_m, double edge_m) { return std::max({-x_m, x_m - edge_m, 0.0}); }

bool reaches(const Crown& crown, Point2d corner_m, double cell_edge_m, double distance_m) {
  const double x_m = distance_to_interval_m(corner_m.x + crown.x_m, cell_edge_m);
  const double y_m = distance_to_interval_m(corner_m.y + crown.y_m, cell_edge_m);
  return std::hypot(x_m, y_m) <= distance_m + reach_m(crown);
}

/// The cells that have a place within a distance of a cell's square.
CellRange cells_within(const Grid& grid, Cell cell, double distance_m) {
  const double farthest = static_cast<double>(std::max(grid.cells.width(), grid.cells.height()));
  const double cells = std::min(std::floor(distance_m / grid.cell_edge_m) + 1.0, farthest);
  const auto n = static_cast<std::int32_t>(cells);
  return CellRange{cell.i - n, cell.j - n, cell.i + n + 1, cell.j + n + 1}.intersection(grid.cells);
}

/// Calls `visit` for each record of a cell in the range.
template <class Visit>
void visit_cells(const CrownsFile& crowns, const CellRange& range, const Visit& visit) {
  auto from = crowns.cells_from({range.i_begin, range.j_begin});
  while (!from.empty() && from.front().j < range.j_end) {
    const CrownCellRecord& record = from.front();
    if (record.i < range.i_begin) {
      from = crowns.cells_from({range.i_begin, record.j});
    } else if (record.i >= range.i_end) {
      from = crowns.cells_from({range.i_begin, record.j + 1});
    } else {
      visit(record);
      from = from.subspan(1);
    }
  }
}

/// How much of its width times its height the outline of a crown fills, as one looks at it from the side.
double fill_of(CrownShape shape) { return shape == CrownShape::spheroid ? 0.25 * std::numbers::pi : 1.0; }

/// From a place to the square [0, edge]² of a cell; 0 within it.
double distance_to_cell(Point2d p_cell, double edge_m) {
  const auto beyond = [edge_m](double x) { return std::max({0.0, -x, x - edge_m}); };
  const double x = beyond(p_cell.x), y = beyond(p_cell.y);
  return std::sqrt(x * x + y * y);
}

/// No place of a cell at `lowest_m` or above sees a crown at a larger slope whose plan is farther than `farthest_m` from the
/// cell.
double highest_slope_beyond(const PackageReader& package, Cell cell, float lowest_m, double farthest_m) {
  double slope = 0.0;
  if (!package.has_crowns()) return slope;
  const double edge_m = package.grid().cell_edge_m;
  const auto cells_apart = [](std::int32_t a, std::int32_t b) {
    return std::abs(static_cast<double>(a) - static_cast<double>(b));
  };
  for (const package::CrownCellRecord& record : package.crowns().cells()) {
    // The farther side of a square is so far from another one that lies so many cells apart
    const double farthest_axis_m = edge_m * std::hypot(cells_apart(record.i, cell.i), cells_apart(record.j, cell.j));
    if (farthest_axis_m > farthest_m)
      slope = std::max(slope, (static_cast<double>(record.z_high_m) - static_cast<double>(lowest_m)) / farthest_m);
  }
  return slope;
}

/// Takes the crowns near a cell, and merges those that are far away.
class CanopyAround {
 public:
  CanopyAround(double cell_edge_m, float lowest_m, const CrownMerging& merging)
      : cell_edge_m_(cell_edge_m), lowest_m_(lowest_m), merging_(merging) {}

  void add(const Crown& crown) {
    if (crown.top_m <= lowest_m_) return;
    const double distance_m = distance_to_cell({crown.x_m, crown.y_m}, cell_edge_m_) - crown.half_width_m;
    if (distance_m <= merging_.named_m) return crowns_.push_back(crown);
    const double square_m = distance_m <= merging_.small_squares_m ? merging_.small_square_m : merging_.large_square_m;
    squares_[{square_m, static_cast<std::int64_t>(std::floor(crown.x_m / square_m)),
              static_cast<std::int64_t>(std::floor(crown.y_m / square_m)), crown.foliage}]
        .push_back(crown);
  }

  [[nodiscard]] BoundedCanopy crowns() && {
    BoundedCanopy canopy{std::move(crowns_), {}};
    for (auto& [square, crowns] : squares_) {
      canopy.crowns.push_back(merged(crowns, std::get<0>(square)));
      crowns.push_back(canopy.crowns.back());
      canopy.envelopes.push_back(enclosing(crowns));
    }
    return canopy;
  }

 private:
  double cell_edge_m_;
  float lowest_m_;
  CrownMerging merging_;
  std::vector<Crown> crowns_;
  /// By the edge of the square, and its place
  std::map<std::tuple<double, std::int64_t, std::int64_t, Foliage>, std::vector<Crown>> squares_;
};

}  // namespace

std::vector<Crown> crowns_near(const PackageReader& package, Cell cell, double distance_m) {
  std::vector<Crown> near;
  if (!package.has_crowns()) return near;
  const CrownsFile& crowns = package.crowns();
  const Grid& grid = package.grid();
  const CellRange range = cells_within(grid, cell, distance_m + std::numbers::sqrt2 * crowns.largest_half_width_m());
  visit_cells(crowns, range, [&](const CrownCellRecord& record) {
    const Point2d corner_m = grid.corner_of({record.i, record.j}) - grid.corner_of(cell);
    for (const Crown& crown : crowns.crowns_of(record))
      if (reaches(crown, corner_m, grid.cell_edge_m, distance_m)) near.push_back(moved(crown, corner_m));
  });
  return near;
}

std::size_t count_crowns_near(const PackageReader& package, Cell cell, double distance_m) {
  std::size_t count = 0;
  if (!package.has_crowns()) return count;
  const CrownsFile& crowns = package.crowns();
  const CellRange range = cells_within(package.grid(), cell, distance_m + std::numbers::sqrt2 * crowns.largest_half_width_m());
  visit_cells(crowns, range, [&](const CrownCellRecord& record) { count += record.crown_count; });
  return count;
}

std::vector<Crown> crowns_of_whole_city(const PackageReader& package, Cell cell) {
  std::vector<Crown> all;
  if (!package.has_crowns()) return all;
  const CrownsFile& crowns = package.crowns();
  const Grid& grid = package.grid();
  all.reserve(crowns.crowns().size());
  for (const CrownCellRecord& record : crowns.cells()) {
    const Point2d corner_m = grid.corner_of({record.i, record.j}) - grid.corner_of(cell);
    for (const Crown& crown : crowns.crowns_of(record)) all.push_back(moved(crown, corner_m));
  }
  return all;
}

Crown merged(const std::vector<Crown>& crowns, double square_m) {
  FARLOD_EXPECTS(!crowns.empty());
  // What one sees of a crown from the side: the sums are weighted by it
  double width = 0.0, x = 0.0, y = 0.0, bottom = 0.0, top = 0.0;
  for (const Crown& c : crowns) {
    const double w = 2.0 * fill_of(c.shape) * c.half_width_m;
    width += w, x += w * c.x_m, y += w * c.y_m, bottom += w * c.bottom_m, top += w * c.top_m;
  }
  const double hidden_m = square_m * -std::expm1(-width / square_m);
  const auto mean = [width](double sum) { return static_cast<float>(sum / width); };
  return {
      mean(x), mean(y), mean(bottom), mean(top), static_cast<float>(0.5 * hidden_m), CrownShape::cylinder, crowns.front().foliage,
      0};
}

Crown enclosing(const std::vector<Crown>& crowns) {
  FARLOD_EXPECTS(!crowns.empty());
  Box2d plan;
  Crown all = crowns.front();
  for (const Crown& c : crowns) {
    const Point2d axis{c.x_m, c.y_m}, reach{reach_m(c), reach_m(c)};
    plan.add(axis - reach);
    plan.add(axis + reach);
    all.bottom_m = std::min(all.bottom_m, c.bottom_m);
    all.top_m = std::max(all.top_m, c.top_m);
  }
  constexpr double rounding_m = 0.01;  // of floats 100 km from the origin
  const Point2d middle = 0.5 * (plan.low + plan.high), size = plan.high - plan.low;
  const auto half_width_m = static_cast<float>(0.5 * std::max(size.x, size.y) + rounding_m);
  return {static_cast<float>(middle.x),
          static_cast<float>(middle.y),
          all.bottom_m,
          all.top_m,
          half_width_m,
          CrownShape::prism,
          all.foliage,
          0};
}

BoundedCanopy bounded_canopy_around(const PackageReader& package, Cell cell, float lowest_m, const CrownMerging& merging) {
  CanopyAround around(package.grid().cell_edge_m, lowest_m, merging);
  for (const Crown& crown : crowns_near(package, cell, merging.farthest_m)) around.add(crown);
  BoundedCanopy canopy = std::move(around).crowns();
  canopy.highest_slope_left_out = static_cast<float>(highest_slope_beyond(package, cell, lowest_m, merging.farthest_m));
  return canopy;
}

std::vector<Crown> canopy_around(const PackageReader& package, Cell cell, float lowest_m, const CrownMerging& merging) {
  return bounded_canopy_around(package, cell, lowest_m, merging).crowns;
}

}  // namespace farlod
