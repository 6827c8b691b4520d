// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/column.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

/// Two hits of the same part on the same side and this close are one surface, met at an edge that two triangles share.
/// Ten times the rounding of a height in a package (0.06 mm at 1 km): a slab is thicker.
constexpr float same_surface_m = 0.0006F;

std::vector<TileView> tiles_around(const Package& package, Cell cell) {
  const std::int32_t r = package.manifest().assign == "whole" ? CellColumns::reach_of_whole_buildings : 0;
  const CellRange range = CellRange{cell.i - r, cell.j - r, cell.i + r + 1, cell.j + r + 1}.intersection(package.grid().cells);
  std::vector<TileView> tiles;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) tiles.push_back(package.tile(range.cell_at(n)));
  return tiles;
}

Occluder occluder_of_tiles(std::span<const TileView> tiles, const Grid& grid, Cell cell) {
  std::vector<PlacedMesh> placed;
  for (const TileView& tile : tiles)
    placed.push_back({tile.mesh, grid.corner_of({tile.cell->i, tile.cell->j}) - grid.corner_of(cell)});
  return occluder_of(placed);
}

}  // namespace

std::optional<float> Column::ground_m() const {
  for (auto c = crossings_.rbegin(); c != crossings_.rend(); ++c)
    if (c->building == package::no_building) return c->height_m;
  return std::nullopt;
}

std::optional<float> Column::highest_m() const {
  return crossings_.empty() ? std::nullopt : std::optional(crossings_.back().height_m);
}

bool Column::is_inside_building(float height_m) const {
  struct Count {
    int up_minus_down = 0;
    float last_height_m = -std::numeric_limits<float>::infinity();
    bool last_looks_up = false;
  };
  std::map<std::pair<std::uint32_t, std::uint16_t>, Count> parts;
  for (const Crossing& c : crossings_) {
    if (c.height_m <= height_m || c.building == package::no_building) continue;
    Count& part = parts[{c.building, c.part}];
    const bool same = c.looks_up == part.last_looks_up && c.height_m - part.last_height_m <= same_surface_m;
    if (!same) part.up_minus_down += c.looks_up ? 1 : -1;
    part.last_height_m = c.height_m;
    part.last_looks_up = c.looks_up;
  }
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.second.up_minus_down > 0; });
}

CellColumns::CellColumns(const Package& package, Cell cell)
    : tiles_(tiles_around(package, cell)), occluder_(occluder_of_tiles(tiles_, package.grid(), cell)) {
  for (const TileView& tile : tiles_)
    if (tile.cell->triangle_count > 0) below_all_m_ = std::min(below_all_m_, tile.cell->z_low_m);
  below_all_m_ -= 1.0F;  // a ray that begins on a surface may miss it
}

Column::Crossing CellColumns::crossing(const Hit& hit) const {
  std::uint32_t triangle = hit.triangle;
  auto tile = tiles_.begin();
  for (; triangle >= tile->mesh.triangles.size(); ++tile) triangle -= static_cast<std::uint32_t>(tile->mesh.triangles.size());
  const package::SurfaceRecord& surface = tile->surface_of(triangle);
  return {below_all_m_ + hit.distance, tile->building_number(surface), surface.part, surface.normal().looks_up()};
}

Column CellColumns::at(float x_cell, float y_cell) const {
  std::vector<Column::Crossing> crossings;
  for (const Hit& hit : occluder_.all_hits({{x_cell, y_cell, below_all_m_}, {0.0F, 0.0F, 1.0F}}))
    crossings.push_back(crossing(hit));
  return Column(std::move(crossings));
}

}  // namespace farlod
