// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/raster_receivers.hpp"

#include <algorithm>
#include <cmath>

#include "contract/cancellation.hpp"

namespace farlod {
namespace {

/// Pixels are listed patch by patch, so that 16 in a row see almost the same.
constexpr std::size_t patch_edge = 4;

PixelRange pixels_over(const RasterPlan& plan, const Box2d& o) {
  const auto clamp = [](double x, std::size_t n) { return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(n))); };
  return {clamp(std::floor((o.low.x - plan.north_west_m.x) / plan.step_m), plan.columns),
          clamp(std::ceil((o.high.x - plan.north_west_m.x) / plan.step_m), plan.columns),
          clamp(std::floor((plan.north_west_m.y - o.high.y) / plan.step_m), plan.rows),
          clamp(std::ceil((plan.north_west_m.y - o.low.y) / plan.step_m), plan.rows)};
}

template <class Visit>
void for_each_pixel_by_patches(const PixelRange& r, const Visit& visit) {
  for (std::size_t row_0 = r.row_begin; row_0 < r.row_end; row_0 += patch_edge)
    for (std::size_t column_0 = r.column_begin; column_0 < r.column_end; column_0 += patch_edge)
      for (std::size_t row = row_0; row < std::min(row_0 + patch_edge, r.row_end); ++row)
        for (std::size_t column = column_0; column < std::min(column_0 + patch_edge, r.column_end); ++column) visit(column, row);
}

}  // namespace

RasterPlan plan_raster(const package::Manifest& m, double step_m, const std::optional<Box2d>& wanted_projected) {
  const Box2d area = wanted_projected ? *wanted_projected : m.projected_outline(m.grid.rectangle());
  const double west = std::floor(area.low.x / step_m), south = std::floor(area.low.y / step_m);
  const double east = std::ceil(area.high.x / step_m), north = std::ceil(area.high.y / step_m);
  return {
      {west * step_m, north * step_m}, step_m, static_cast<std::size_t>(east - west), static_cast<std::size_t>(north - south)};
}

std::vector<Cell> RasterReceivers::cells() const {
  std::vector<Cell> result;
  const CellRange& range = manifest_.grid.cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n)
    if (!range_of(range.cell_at(n)).empty()) result.push_back(range.cell_at(n));
  return result;
}

PixelRange RasterReceivers::range_of(Cell cell) const {
  return pixels_over(plan_, manifest_.projected_outline(manifest_.grid.square_of(cell)));
}

template <class Visit>
void RasterReceivers::for_each_pixel(Cell cell, const Visit& visit) const {
  const Grid& grid = manifest_.grid;
  for_each_pixel_by_patches(range_of(cell), [&](std::size_t column, std::size_t row) {
    const Point2d p_grid = manifest_.grid_from_projected(plan_.centre_m(column, row));
    if (grid.cell_of(p_grid) == cell) visit(row * plan_.columns + column, p_grid);
  });
}

CellReceivers RasterReceivers::in_cell(const PackageReader& package, Cell cell, HeightAbove above, float height_m,
                                       const std::stop_token& stop) const {
  const PointLocator locator(package, cell);
  CellReceivers result{cell, {}};
  for_each_pixel(cell, [&](std::size_t index, Point2d p_grid) {
    throw_if_cancelled(stop);
    const Point2d p = p_grid - manifest_.grid.corner_of(cell);
    if (const auto p_cell = stand(locator, static_cast<float>(p.x), static_cast<float>(p.y), above, height_m))
      result.receivers.push_back({index, *p_cell});
    else
      ++result.left_out;
  });
  return result;
}

}  // namespace farlod
