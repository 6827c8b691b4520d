// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/terrain_seams.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "city/geometry.hpp"
#include "farlod/box.hpp"

namespace farlod::plausibility {
namespace {

/// Nodes at the borders of a tile, each with the one behind it, seen from outside.
template <class Visit>
void for_each_border_node(const TerrainRaster& tile, const Visit& visit) {
  if (tile.columns < 2 || tile.rows < 2) return;
  const std::size_t east = tile.columns - 1, north = tile.rows - 1;
  const auto at = [&](std::size_t column, std::size_t row) { return row * tile.columns + column; };
  for (std::size_t row = 0; row < tile.rows; ++row) {
    visit(tile.node(0, row), at(0, row), at(1, row), Point2d{-1.0, 0.0});
    visit(tile.node(east, row), at(east, row), at(east - 1, row), Point2d{1.0, 0.0});
  }
  for (std::size_t column = 0; column < tile.columns; ++column) {
    visit(tile.node(column, 0), at(column, 0), at(column, 1), Point2d{0.0, -1.0});
    visit(tile.node(column, north), at(column, north), at(column, north - 1), Point2d{0.0, 1.0});
  }
}

/// With the half pixels beyond its nodes.
Box2d tile_box(const TerrainRaster& tile) {
  return {tile.first - tile.step_m, tile.node(tile.columns - 1, tile.rows - 1) + tile.step_m};
}

/// How much higher `other` is than `tile` at each node of its border that meets it.
std::vector<double> steps_along(const TerrainRaster& tile, const TerrainRaster& other) {
  std::vector<double> steps_m;
  for_each_border_node(other, [&](Point2d node, std::size_t n, std::size_t behind, Point2d outwards) {
    if (!other.height_m[n] || !other.height_m[behind]) return;
    if (const auto below_m = tile.height_at(node)) return steps_m.push_back(*other.height_m[n] - *below_m);
    // Beside each other, pixels touch: from node to node it is half a pixel of each, and a little more against rounding
    const Point2d apart{0.5 * (tile.step_m.x + other.step_m.x) * outwards.x, 0.5 * (tile.step_m.y + other.step_m.y) * outwards.y};
    const double rounding = 1.001, own_step = std::abs(outwards.x) > 0.0 ? other.step_m.x : other.step_m.y;
    const auto beside_m = tile.height_at(node + rounding * apart);
    if (!beside_m) return;
    const double slope = (*other.height_m[n] - *other.height_m[behind]) / own_step;
    steps_m.push_back(*other.height_m[n] + slope * rounding * norm(apart) - *beside_m);
  });
  return steps_m;
}

}  // namespace

std::optional<TerrainSeam> seam_between(const TerrainRaster& tile, const TerrainRaster& other) {
  constexpr double least_m = 3.0, impossible_m = 40.0;
  constexpr std::size_t fewest = 8;
  if (!boxes_meet(tile_box(tile), tile_box(other))) return std::nullopt;
  std::vector<double> steps_m = steps_along(tile, other);
  if (steps_m.size() < fewest) return std::nullopt;
  std::sort(steps_m.begin(), steps_m.end());
  const auto at = [&](double share) {
    return steps_m[static_cast<std::size_t>(share * static_cast<double>(steps_m.size() - 1))];
  };
  const double median_m = at(0.5);
  if (std::abs(median_m) < std::max(least_m, at(0.75) - at(0.25))) return std::nullopt;
  return TerrainSeam{median_m, at(0.05) > impossible_m || at(0.95) < -impossible_m};
}

std::vector<std::size_t> blank_tiles(std::span<const TerrainRaster> tiles) {
  constexpr float least_gap_m = 20.0F;
  float lowest_m = std::numeric_limits<float>::infinity();
  std::vector<std::size_t> blank;
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    float low_m = std::numeric_limits<float>::infinity(), high_m = -low_m;
    for (const auto& height_m : tiles[n].height_m) {
      if (!height_m) continue;
      low_m = std::min(low_m, *height_m);
      high_m = std::max(high_m, *height_m);
    }
    if (low_m == high_m && (low_m == 0.0F || low_m == -1.0F))
      blank.push_back(n);
    else
      lowest_m = std::min(lowest_m, low_m);
  }
  const bool is_far_below = lowest_m >= least_gap_m && std::isfinite(lowest_m);
  return is_far_below ? blank : std::vector<std::size_t>{};
}

}  // namespace farlod::plausibility
