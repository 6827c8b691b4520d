// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/far_ground.hpp"

#include <algorithm>

#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

/// The triangles of the far terrain whose outlines meet the square of a cell, in its frame.
std::vector<PlanTriangle> far_triangles_over(const PackageReader& package, Cell cell) {
  const Grid& grid = package.grid();
  const MeshView mesh = package.far_terrain();
  const Point2d shift_m = grid.middle_corner() - grid.corner_of(cell);
  const auto edge_m = static_cast<float>(grid.cell_edge_m);
  std::vector<PlanTriangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    const PlanTriangle corners{placed(mesh.vertices[t.a], shift_m), placed(mesh.vertices[t.b], shift_m),
                               placed(mesh.vertices[t.c], shift_m)};
    const PlanOutline outline = outline_of(corners);
    const bool is_met = outline.west <= edge_m && outline.east >= 0.0F && outline.south <= edge_m && outline.north >= 0.0F;
    if (is_met && plan_area(corners) != 0.0) triangles.push_back(corners);
  }
  return triangles;
}

}  // namespace

FarGround::FarGround(const PackageReader& package, Cell cell) : index_(far_triangles_over(package, cell)) {}

std::optional<float> FarGround::height_at(float x_cell, float y_cell) const {
  std::vector<PlanCrossing> crossings;
  index_.find(x_cell, y_cell, crossings);
  if (crossings.empty()) return std::nullopt;
  return std::ranges::max_element(crossings, {}, &PlanCrossing::height_m)->height_m;
}

}  // namespace farlod
