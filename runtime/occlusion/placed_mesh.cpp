// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "occlusion/placed_mesh.hpp"

#include <string>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

/// Vertices and triangles of a scene have numbers of 32 bits, the last of which means none.
void require_numbers_for(std::size_t vertex_count, std::size_t triangle_count) {
  constexpr std::size_t most = 0xFFFFFFFE;
  if (vertex_count <= most && triangle_count <= most) return;
  throw LimitReached("a scene would have " + std::to_string(vertex_count) + " corners and " + std::to_string(triangle_count) +
                     " triangles, and can have " + std::to_string(most) +
                     " of each: leave out what needs the whole city in one scene (the engine exact, a verification, a largest "
                     "error, points beyond the grid, cells without a far map), or pack a part of the city.");
}

}  // namespace

Occluder occluder_of(std::span<const PlacedMesh> tiles, const std::stop_token& stop) {
  std::size_t vertex_count = 0, triangle_count = 0;
  for (const PlacedMesh& tile : tiles) {
    vertex_count += tile.mesh.vertices.size();
    triangle_count += tile.mesh.triangles.size();
  }
  require_numbers_for(vertex_count, triangle_count);
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
                           const std::function<MeshView(Cell)>& mesh_of, const std::stop_token& stop, const MeshView& beyond) {
  std::vector<PlacedMesh> placed;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    throw_if_cancelled(stop);
    const Cell cell = cells.cell_at(n);
    placed.push_back({mesh_of(cell), grid.corner_of(cell) - origin_grid});
  }
  placed.push_back({beyond, {}});
  return occluder_of(placed, stop);
}

}  // namespace farlod
