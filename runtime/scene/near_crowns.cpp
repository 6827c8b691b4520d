// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/near_crowns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

}  // namespace farlod
