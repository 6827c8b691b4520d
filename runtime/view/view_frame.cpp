// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_frame.hpp"

#include <cmath>
#include <optional>

namespace farlod {
ViewFrame view_frame_of(const Package& package) {
  const PackageDescription& d = package.description();
  const PackageInventory inventory = inventory_of(package);
  const std::optional<HeightRange> heights = heights_of(package);
  const Box2d& outline = d.outline_projected;
  ViewFrame frame{
      .origin_projected = {std::round(0.5 * (outline.low.x + outline.high.x)), std::round(0.5 * (outline.low.y + outline.high.y)),
                           heights ? std::floor(heights->low_m) : inventory.height_origin_m},
      .grid_axes = GridAxes::turned_by(d.grid_bearing),
      .convergence = d.convergence,
      .cell_edge_m = d.cell_edge_m,
      .cells = inventory.cells,
      .corner_local = {}};
  // The grid is turned about the origin of the city frame
  const Point2d first{inventory.cells.i_begin * d.cell_edge_m, inventory.cells.j_begin * d.cell_edge_m};
  frame.corner_local =
      inventory.origin_m - horizontal(frame.origin_projected) + first.x * frame.grid_axes.x + first.y * frame.grid_axes.y;
  if (heights) {
    frame.low_local = heights->low_m - frame.origin_projected.z;
    frame.high_local = heights->high_m - frame.origin_projected.z;
  }
  return frame;
}

}  // namespace farlod
