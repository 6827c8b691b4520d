// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_frame.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace farlod {
namespace {

struct HeightRange {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};

HeightRange around(const HeightRange& a, const HeightRange& b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

/// Of the vertices of all cells, above sea level.
HeightRange heights_of(const Package& package, const CellRectangle& cells) {
  const auto columns = static_cast<std::size_t>(cells.i_end - cells.i_begin);
  const std::size_t count = columns * static_cast<std::size_t>(cells.j_end - cells.j_begin);
  const auto add_cells = [&](const oneapi::tbb::blocked_range<std::size_t>& range, HeightRange heights) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      const CellPlace cell{cells.i_begin + static_cast<std::int32_t>(n % columns),
                           cells.j_begin + static_cast<std::int32_t>(n / columns)};
      const CellContents contents = inspect_cell(package, cell);
      if (contents.low_m) heights = around(heights, {*contents.low_m, *contents.high_m});
    }
    return heights;
  };
  return oneapi::tbb::parallel_reduce(oneapi::tbb::blocked_range<std::size_t>(0, count), HeightRange{}, add_cells, around);
}

}  // namespace

ViewFrame view_frame_of(const Package& package) {
  const PackageDescription& d = package.description();
  const PackageInventory inventory = inventory_of(package);
  const HeightRange heights = heights_of(package, inventory.cells);
  const bool has_heights = heights.low <= heights.high;
  const Box2d& outline = d.outline_projected;
  ViewFrame frame{
      .origin_projected = {std::round(0.5 * (outline.low.x + outline.high.x)), std::round(0.5 * (outline.low.y + outline.high.y)),
                           has_heights ? std::floor(heights.low) : inventory.height_origin_m},
      .grid_bearing = d.grid_bearing,
      .convergence = d.convergence,
      .cell_edge_m = d.cell_edge_m,
      .cells = inventory.cells,
      .corner_local = {}};
  // The grid is turned about the origin of the city frame
  const Point2d first{inventory.cells.i_begin * d.cell_edge_m, inventory.cells.j_begin * d.cell_edge_m};
  frame.corner_local =
      inventory.origin_m - horizontal(frame.origin_projected) + first.x * frame.x_axis() + first.y * frame.y_axis();
  if (has_heights) {
    frame.low_local = heights.low - frame.origin_projected.z;
    frame.high_local = heights.high - frame.origin_projected.z;
  }
  return frame;
}

}  // namespace farlod
