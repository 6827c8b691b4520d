// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/vertical_profile.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "contract/ground_contact.hpp"
#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

/// Two hits of the same part on the same side and this close are one surface, met at an edge that two triangles share.
/// Ten times the rounding of a height in a package (0.06 mm at 1 km): a slab is thicker.
constexpr float same_surface_m = 0.0006F;

std::vector<TileView> tiles_around(const PackageReader& package, Cell cell) {
  const std::int32_t r = package.manifest().assign == "whole" ? PointLocator::reach_of_whole_buildings : 0;
  const CellRange range = CellRange{cell.i - r, cell.j - r, cell.i + r + 1, cell.j + r + 1}.intersection(package.grid().cells);
  std::vector<TileView> tiles;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) tiles.push_back(package.tile(range.cell_at(n)));
  return tiles;
}

std::vector<PlanIndex::Corners> triangles_of(std::span<const TileView> tiles, const Grid& grid, Cell cell) {
  std::vector<PlanIndex::Corners> triangles;
  for (const TileView& tile : tiles) {
    const Point2d shift_m = grid.corner_of({tile.cell->i, tile.cell->j}) - grid.corner_of(cell);
    const auto corner = [&](std::uint32_t v) { return placed(tile.mesh.vertices[v], shift_m); };
    for (const Triangle& t : tile.mesh.triangles) triangles.push_back({corner(t.a), corner(t.b), corner(t.c)});
  }
  return triangles;
}

}  // namespace

std::optional<float> VerticalProfile::ground_m() const {
  for (auto c = crossings_.rbegin(); c != crossings_.rend(); ++c)
    if (c->building == package::no_building) return c->height_m;
  return std::nullopt;
}

std::optional<float> VerticalProfile::highest_m() const {
  return crossings_.empty() ? std::nullopt : std::optional(crossings_.back().height_m);
}

bool VerticalProfile::is_inside_building(float height_m) const {
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

bool VerticalProfile::is_buried(float height_m) const {
  const std::optional<float> ground = ground_m();
  return (ground && (height_m < *ground || is_below_standing_floor(height_m, *ground))) || is_inside_building(height_m);
}

bool VerticalProfile::is_below_standing_floor(float height_m, float ground_m) const {
  const float highest_m = ground_m + static_cast<float>(ground_contact_m);
  return std::any_of(crossings_.begin(), crossings_.end(), [=](const Crossing& c) {
    return c.building != package::no_building && !c.looks_up && c.height_m > height_m && c.height_m <= highest_m;
  });
}

PointLocator::PointLocator(const PackageReader& package, Cell cell)
    : tiles_(tiles_around(package, cell)), index_(triangles_of(tiles_, package.grid(), cell)) {
  for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile)
    for (std::uint32_t t = 0; t < tiles_[tile].mesh.triangles.size(); ++t) places_.emplace_back(tile, t);
}

VerticalProfile PointLocator::at(float x_cell, float y_cell) const {
  std::vector<PlanIndex::Crossing> found;
  index_.find(x_cell, y_cell, found);
  std::vector<VerticalProfile::Crossing> crossings;
  crossings.reserve(found.size());
  for (const PlanIndex::Crossing& c : found) {
    const auto [tile, triangle] = places_[c.triangle];
    const package::SurfaceRecord& surface = tiles_[tile].surface_of(triangle);
    crossings.push_back({c.height_m, tiles_[tile].building_number(surface), surface.part, surface.normal().looks_up()});
  }
  std::stable_sort(
      crossings.begin(), crossings.end(),
      [](const VerticalProfile::Crossing& a, const VerticalProfile::Crossing& b) { return a.height_m < b.height_m; });
  return VerticalProfile(std::move(crossings));
}

}  // namespace farlod
