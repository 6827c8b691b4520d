// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ray_scenes.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "scene/canopy_around.hpp"
#include "scene/near_cells.hpp"

namespace farlod {
namespace {

/// Nothing is rounded on the way: a float some kilometres from the origin is half a millimetre off.
Point3d moved(const Point3f& p, Point2d by_m) { return {p.x + by_m.x, p.y + by_m.y, p.z}; }

std::vector<TriangleIndex::Corners> triangles_of_whole_city(const PackageReader& package, const std::stop_token& stop) {
  std::vector<TriangleIndex::Corners> triangles;
  const auto add = [&](const MeshView& mesh, Point2d corner_m) {
    throw_if_cancelled(stop);
    const auto corner = [&](std::uint32_t number) { return moved(mesh.vertices[number], corner_m); };
    for (const Triangle& t : mesh.triangles) triangles.push_back({corner(t.a), corner(t.b), corner(t.c)});
  };
  const Grid& grid = package.grid();
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    const Cell cell = grid.cells.cell_at(n);
    add(package.tile(cell).mesh, grid.corner_of(cell) - grid.middle_corner());
  }
  add(package.far_terrain(), {});
  return triangles;
}

}  // namespace

Occluder near_scene(const PackageReader& package, Cell cell) {
  const Grid& grid = package.grid();
  return occluder_of_cells(grid, near_cells_of(grid, cell), grid.corner_of(cell), [&](Cell c) { return package.tile(c).mesh; });
}

WholeCity::WholeCity(const PackageReader& package, const std::stop_token& stop)
    : grid_(package.grid()),
      origin_grid_(grid_.middle_corner()),
      occluder_(occluder_of_cells(
          grid_, grid_.cells, origin_grid_, [&](Cell c) { return package.tile(c).mesh; }, stop, package.far_terrain())) {}

Point3f WholeCity::scene_from_cell(const Point3f& p_cell, Cell cell) const { return placed(p_cell, scene_from_cell_m(cell)); }

WholeCityOnDemand::WholeCityOnDemand(const PackageReader& package, std::stop_token stop)
    : package_(package), stop_(std::move(stop)) {}

const WholeCity& WholeCityOnDemand::city() const {
  std::call_once(has_city_, [&] { city_.emplace(package_, stop_); });
  return *city_;
}

const SeenSurfaces& WholeCityOnDemand::surfaces() const {
  std::call_once(has_surfaces_, [&] { surfaces_.emplace(package_, stop_); });
  return *surfaces_;
}

const SeenBuilding& WholeCityOnDemand::building(const std::string& id) const {
  std::call_once(has_building_, [&] { building_.emplace(package_, id, stop_); });
  return *building_;
}

const TriangleIndex& WholeCityOnDemand::triangles() const {
  std::call_once(has_triangles_, [&] { triangles_.emplace(triangles_of_whole_city(package_, stop_)); });
  return *triangles_;
}

Point3d WholeCityOnDemand::scene_from_cell(const Point3f& p_cell, Cell cell) const {
  const Grid& grid = package_.grid();
  return moved(p_cell, grid.corner_of(cell) - grid.middle_corner());
}

const CrownOccluder& WholeCityOnDemand::crowns(const CanopySettings& settings) const {
  std::call_once(has_crowns_, [&] {
    const Grid& grid = package_.grid();
    crowns_.emplace(crowns_of_whole_city(package_, grid.cell_of(grid.middle_corner())), settings, stop_);
  });
  return *crowns_;
}

}  // namespace farlod
