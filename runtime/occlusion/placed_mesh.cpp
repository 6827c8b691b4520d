// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "occlusion/placed_mesh.hpp"

#include <utility>
#include <vector>

#include "contract/cancellation.hpp"
#include "contract/expects.hpp"

namespace farlod {

Occluder occluder_of(std::span<const PlacedMesh> tiles, const std::stop_token& stop) {
  std::size_t vertex_count = 0, triangle_count = 0;
  for (const PlacedMesh& tile : tiles) {
    vertex_count += tile.mesh.vertices.size();
    triangle_count += tile.mesh.triangles.size();
  }
  FARLOD_EXPECTS(vertex_count < 0xFFFFFFFF && triangle_count < 0xFFFFFFFF);
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  vertices.reserve(vertex_count + 1);  // Embree wants one more, for padding
  triangles.reserve(triangle_count);
  for (const PlacedMesh& tile : tiles) {
    throw_if_cancelled(stop);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Point3f& p : tile.mesh.vertices) vertices.push_back(placed(p, tile.corner_m));
    for (const Triangle& t : tile.mesh.triangles) triangles.push_back({t.a + first, t.b + first, t.c + first});
  }
  return {std::move(vertices), std::move(triangles), stop};
}

Occluder occluder_of_cells(const Grid& grid, const CellRange& cells, Point2d origin_grid,
                           const std::function<MeshView(Cell)>& mesh_of, const std::stop_token& stop) {
  std::vector<PlacedMesh> placed;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    throw_if_cancelled(stop);
    const Cell cell = cells.cell_at(n);
    placed.push_back({mesh_of(cell), grid.corner_of(cell) - origin_grid});
  }
  return occluder_of(placed, stop);
}

}  // namespace farlod
