// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/vertical_profile.hpp"

#include <algorithm>
#include <limits>

#include "base/ground_contact.hpp"
#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

/// Two hits of the same part on the same side and this close are one surface, met at an edge that two triangles share.
/// Ten times the rounding of a height in a package (0.06 mm at 1 km): a slab is thicker.
constexpr float same_surface_m = 0.0006F;

using Crossing = VerticalProfile::Crossing;

bool are_of_one_part(const Crossing& a, const Crossing& b) { return a.building == b.building && a.part == b.part; }

/// How many surfaces of the part of the first crossing look up, minus those that look down.
int up_minus_down(std::span<const Crossing> crossings) {
  const Crossing& first = crossings.front();
  int count = 0;
  const Crossing* last = nullptr;
  for (const Crossing& c : crossings) {
    if (!are_of_one_part(c, first)) continue;
    const bool same = last != nullptr && c.looks_up == last->looks_up && c.height_m - last->height_m <= same_surface_m;
    if (!same) count += c.looks_up ? 1 : -1;
    last = &c;
  }
  return count;
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

void VerticalProfile::add(const Crossing& crossing) {
  const auto place = std::upper_bound(crossings_.begin(), crossings_.end(), crossing,
                                      [](const Crossing& a, const Crossing& b) { return a.height_m < b.height_m; });
  crossings_.insert(place, crossing);
}

bool VerticalProfile::is_inside_building(float height_m) const {
  const auto above = std::find_if(crossings_.begin(), crossings_.end(), [=](const Crossing& c) { return c.height_m > height_m; });
  // A part is counted at its first surface above. A place has few of them: a map of the parts would take longer than to look for
  // them among the others
  for (auto c = above; c != crossings_.end(); ++c) {
    if (c->building == package::no_building) continue;
    const bool is_first = std::none_of(above, c, [c](const Crossing& before) { return are_of_one_part(before, *c); });
    if (is_first && up_minus_down(std::span(c, crossings_.end())) > 0) return true;
  }
  return false;
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

TrianglesOfCell::TrianglesOfCell(const PackageReader& package, Cell cell) {
  const Grid& grid = package.grid();
  const std::int32_t r = package.manifest().assign == "whole" ? reach_of_whole_buildings : 0;
  const CellRange range = CellRange{cell.i - r, cell.j - r, cell.i + r + 1, cell.j + r + 1}.intersection(grid.cells);
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) {
    const Cell there = range.cell_at(n);
    add(package.tile(there), grid.corner_of(there) - grid.corner_of(cell));
  }
}

void TrianglesOfCell::add(const TileView& tile, Point2d shift_m) {
  const auto corner = [&](std::uint32_t v) { return placed(tile.mesh.vertices[v], shift_m); };
  std::uint32_t t = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    const package::SurfaceRecord& surface = tile.surfaces[run.surface];
    const Surface of_run{tile.building_number(surface), surface.part, surface.normal().looks_up()};
    for (; t < run.end; ++t) {
      const Triangle& numbers = tile.mesh.triangles[t];
      const PlanTriangle corners{corner(numbers.a), corner(numbers.b), corner(numbers.c)};
      if (plan_area(corners) == 0.0) continue;
      corners_.push_back(corners);
      surfaces_.push_back(of_run);
    }
  }
}

void TrianglesOfCell::make_profile(std::span<const PlanCrossing> crossings, VerticalProfile& profile) const {
  profile.clear();
  for (const PlanCrossing& c : crossings) {
    const Surface& surface = surfaces_[c.triangle];
    profile.add({c.height_m, surface.building, surface.part, surface.looks_up});
  }
}

VerticalProfile PointLocator::at(float x_cell, float y_cell) const {
  std::vector<PlanCrossing> found;
  index_.find(x_cell, y_cell, found);
  VerticalProfile profile;
  triangles_.make_profile(found, profile);
  return profile;
}

const VerticalProfile& LatticeLocator::at(std::size_t n) {
  triangles_.make_profile(crossings_.at(n), profile_);
  return profile_;
}

}  // namespace farlod
