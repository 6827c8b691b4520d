// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/box_map_baker.hpp"
#include "base/cancellation.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <limits>

namespace farlod {
namespace {

/// Rays begin this much (relative) before the neighborhood's border, so that a wall that stands on the border, and hence belongs
/// to the far side, is not missed by rounding: the float origin, the division and the product round once each.
constexpr double border_rounding = 4.0 * std::numeric_limits<float>::epsilon();

}  // namespace

BakedBoxes BoxMapBaker::bake(Block block, const std::stop_token& stop) const {
  const CellRange range = grid_.cells_of(block);
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) cells.push_back(range.cell_at(n));
  return bake(cells, stop);
}

BakedBoxes BoxMapBaker::bake(std::span<const Cell> cells, const std::stop_token& stop) const {
  BakedBoxes maps(cells.size());
  // Blocks may be baked at the same time: what ends another one must not leave this one half done
  oneapi::tbb::task_group_context of_its_own(oneapi::tbb::task_group_context::isolated);
  const auto bake_one = [&](std::size_t n) {
    throw_if_cancelled(stop);
    maps[n] = bake_cell(cells[n]);
  };
  oneapi::tbb::parallel_for(std::size_t{0}, maps.size(), bake_one, of_its_own);
  return maps;
}

BakedBox BoxMapBaker::bake_cell(Cell cell) const {
  const auto half_edge = static_cast<float>(0.5 * grid_.cell_edge_m);
  const float height_m = tiles_.tile(cell).ground_at_centre_m + static_cast<float>(settings_.capture_height_m);
  BakedBox map{{half_edge, half_edge, height_m}, {settings_.side_columns, settings_.rows, height_bound_.top(cell, height_m)}, {}};
  if (map.shape.top == 0.0F) return map;
  const Point3f capture = city_.frame_from_grid(grid_.centre_of(cell), height_m);
  const CellRange near = grid_.neighborhood_of(cell);
  map.distance_m.reserve(static_cast<std::size_t>(map.shape.columns()) * map.shape.rows);
  for (std::uint32_t row = 0; row < map.shape.rows; ++row)
    for (std::uint32_t column = 0; column < map.shape.columns(); ++column)
      map.distance_m.push_back(distance_m(capture, map.shape.direction_of({column, row}), near));
  return map;
}

float BoxMapBaker::distance_m(const Point3f& capture, const Point3d& d, const CellRange& near) const {
  // The direction's longer horizontal component is 1, so that the ray's parameter is the distance to a wall of the box
  Ray ray{capture, {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}};
  std::optional<Hit> hit;
  const auto is_far = [&](std::uint32_t triangle) { return !near.contains(city_.cell_of_triangle(triangle)); };
  if (assign_ == Assign::clip) {
    const double border_m = grid_.neighborhood_half_edge_m();
    ray.begin = static_cast<float>(border_m * (1.0 - border_rounding));
    hit = city_.occluder().nearest(ray);
    // What stands on the border itself is near in the west and south, far in the east and north
    if (hit && hit->distance < border_m * (1.0 + border_rounding) && !is_far(hit->triangle))
      hit = city_.occluder().nearest(ray, is_far);
  } else {
    // Whole buildings cross the border: whose cell they belong to decides, not where they stand
    hit = city_.occluder().nearest(ray, is_far);
  }
  return hit ? static_cast<float>(hit->distance * norm(d)) : std::numeric_limits<float>::infinity();
}

}  // namespace farlod
