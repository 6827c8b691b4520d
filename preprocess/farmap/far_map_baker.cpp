// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/far_map_baker.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

/// Buildings that are assigned whole may lean into the capture point itself; a map this tall (85°) is tall enough.
constexpr double tallest_top = 11.43;

}  // namespace

FarHeightBound::FarHeightBound(const TileSet& tiles, const Grid& grid) : grid_(grid), cells_(tiles.cells) {
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    const Point2d corner = grid.corner_of(cells_.cell_at(n));
    Prism prism{{}, tiles.tiles[n].z_high_m};
    for (const Point3f& p : tiles.tiles[n].vertices) prism.outline_grid.add(corner + Point2d{p.x, p.y});
    tiles_.push_back(prism);
  }
  add_far_terrain(tiles.far_terrain);
  for (const Block block : grid.blocks()) {
    BlockPrism b{{{}, -std::numeric_limits<float>::infinity()}, grid.cells_of(block)};
    for (std::size_t n = 0; n < static_cast<std::size_t>(b.cells.size()); ++n) {
      const Prism& tile = tiles_[cells_.index_of(b.cells.cell_at(n))];
      if (tile.outline_grid.empty()) continue;
      b.prism.height_m = std::max(b.prism.height_m, tile.height_m);
      b.prism.outline_grid.add(tile.outline_grid.low);
      b.prism.outline_grid.add(tile.outline_grid.high);
    }
    blocks_.push_back(b);
  }
}

void FarHeightBound::add_far_terrain(const FarTerrain& far_terrain) {
  const Point2d origin_grid = grid_.middle_corner();
  for (const Triangle& t : far_terrain.triangles) {
    Prism& prism = far_terrain_.emplace_back(Prism{{}, -std::numeric_limits<float>::infinity()});
    for (const std::uint32_t v : {t.a, t.b, t.c}) {
      const Point3f& p = far_terrain.vertices[v];
      prism.outline_grid.add(origin_grid + Point2d{p.x, p.y});
      prism.height_m = std::max(prism.height_m, p.z);
    }
  }
}

double FarHeightBound::slope(const Prism& prism, Point2d c, float capture_height_m) {
  if (prism.outline_grid.empty() || prism.height_m <= capture_height_m) return 0.0;
  const Box2d& o = prism.outline_grid;
  const double distance = std::max({o.low.x - c.x, c.x - o.high.x, o.low.y - c.y, c.y - o.high.y, 0.0});
  return std::min(tallest_top, static_cast<double>(prism.height_m - capture_height_m) / distance);
}

float FarHeightBound::top(Cell cell, float capture_height_m) const {
  const Point2d centre = grid_.centre_of(cell);
  const CellRange near = grid_.neighborhood_of(cell);
  double top = 0.0;
  for (const Prism& triangle : far_terrain_) top = std::max(top, slope(triangle, centre, capture_height_m));
  for (const BlockPrism& block : blocks_) {
    if (slope(block.prism, centre, capture_height_m) <= top) continue;
    for (std::size_t n = 0; n < static_cast<std::size_t>(block.cells.size()); ++n) {
      const Cell c = block.cells.cell_at(n);
      if (!near.contains(c)) top = std::max(top, slope(tiles_[cells_.index_of(c)], centre, capture_height_m));
    }
  }
  // One float above, so that the highest point itself lies below the top
  return top > 0.0 ? std::nextafter(static_cast<float>(top), std::numeric_limits<float>::infinity()) : 0.0F;
}

namespace {

std::vector<std::uint32_t> first_triangles(const TileSet& tiles) {
  std::vector<std::uint32_t> first;
  std::uint32_t next = 0;
  for (const Tile& tile : tiles.tiles) {
    first.push_back(next);
    next += static_cast<std::uint32_t>(tile.triangles.size());
  }
  first.push_back(next);
  return first;
}

}  // namespace

CityOccluder::CityOccluder(const TileSet& tiles, const Grid& grid)
    : cells_(tiles.cells),
      origin_grid_(grid.middle_corner()),
      first_triangle_(first_triangles(tiles)),
      occluder_(occluder_of_cells(
          grid, cells_, origin_grid_, [&](Cell c) { return tiles.tile(c).mesh(); }, {}, tiles.far_terrain.mesh())) {}

Cell CityOccluder::cell_of_triangle(std::uint32_t triangle) const {
  if (triangle >= first_triangle_.back()) return beyond_grid;
  // Empty tiles begin where the next one does: the last that begins at or before the triangle holds it
  const auto after = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), triangle);
  return cells_.cell_at(static_cast<std::size_t>(after - first_triangle_.begin()) - 1);
}

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
  const bool far_terrain_may_be_near = !tiles_.far_terrain.empty() && near.intersection(grid_.cells) != near;
  if (assign_ == Assign::clip && !far_terrain_may_be_near) {
    const double border_m = grid_.neighborhood_half_edge_m();
    ray.begin = static_cast<float>(border_m * (1.0 - border_rounding));
    hit = city_.occluder().nearest(ray);
    // What stands on the border itself is near in the west and south, far in the east and north
    if (hit && hit->distance < border_m * (1.0 + border_rounding) && !is_far(hit->triangle))
      hit = city_.occluder().nearest(ray, is_far);
  } else {
    // Whole buildings cross the border, and the far terrain begins at that of the grid: what a triangle belongs to decides, not
    // where it stands
    hit = city_.occluder().nearest(ray, is_far);
  }
  return hit ? static_cast<float>(hit->distance * norm(d)) : std::numeric_limits<float>::infinity();
}

FarMapBaker::FarMapBaker(const TileSet& tiles, const Grid& grid, Assign assign, const FarMapSettings& settings) : grid_(grid) {
  if (settings.kind == FarMapKind::box) {
    box_ = std::make_unique<BoxMapBaker>(tiles, grid, assign, settings.box);
  } else {
    horizon_ = std::make_unique<HorizonMapBaker>(tiles, grid, settings.horizon);
  }
}
FarMapBaker::FarMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings, CityHorizon city)
    : grid_(grid), horizon_(std::make_unique<HorizonMapBaker>(tiles, grid, settings, std::move(city))) {}
const CityHorizon* FarMapBaker::horizon() const { return horizon_ ? &horizon_->city() : nullptr; }
FarMapBaker::FarMapBaker(FarMapBaker&&) noexcept = default;
FarMapBaker::~FarMapBaker() = default;

BakedBlock FarMapBaker::bake(Block block, const std::stop_token& stop) const {
  if (box_) return box_->bake(block, stop);
  return horizon_->bake(block, stop);
}

BakedBlock FarMapBaker::bake(Block block, const package::CellRuns& cells, const std::stop_token& stop) const {
  const CellRange range = grid_.cells_of(block);
  std::vector<Cell> chosen;
  for (const std::size_t place : cells.places()) chosen.push_back(range.cell_at(place));
  if (box_) return box_->bake(chosen, stop);
  return horizon_->bake(chosen, {range.i_begin, range.j_begin}, stop);
}

package::FarMapShape shape_of(const FarMapSettings& settings) {
  package::FarMapShape shape;
  if (settings.kind == FarMapKind::box) {
    shape.kind = "box";
    shape.side_columns = settings.box.side_columns;
    shape.rows = settings.box.rows;
    return shape;
  }
  shape.kind = "horizon";
  shape.azimuth_bins = settings.horizon.azimuth_bins;
  shape.squares_per_edge = settings.horizon.squares_per_edge;
  shape.layers = settings.horizon.layers;
  shape.tolerance = settings.horizon.tolerance;
  return shape;
}

}  // namespace farlod
