// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/cell_faces.hpp"

#include <algorithm>
#include <utility>

namespace farlod {
namespace {

Point3d placed_corner(const Point3f& p, Point2d shift_m) { return {p.x + shift_m.x, p.y + shift_m.y, double{p.z}}; }

/// The outward normal of the surface says which way round the corners run: the package does not promise that.
CellFace face_of(const TileView& tile, const Triangle& t, const package::SurfaceRecord& surface, Point2d shift_m) {
  CellFace face;
  const auto& v = tile.mesh.vertices;
  face.corners = {placed_corner(v[t.a], shift_m), placed_corner(v[t.b], shift_m), placed_corner(v[t.c], shift_m)};
  auto& [a, b, c] = face.corners;
  const Point3f outward = surface.normal().direction();
  face.of_surface = {outward.x, outward.y, outward.z};
  face.normal = normalized(cross(b - a, c - a));
  if (dot(face.normal, face.of_surface) < 0.0) {
    std::swap(b, c);
    face.normal = -1.0 * face.normal;
  }
  face.building = tile.building_number(surface);
  face.low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
  face.high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
  return face;
}

/// Calls `visit(face, kind)` for each triangle with an area.
template <class Visit>
void for_each_face(const TileView& tile, Point2d shift_m, const Visit& visit) {
  std::uint32_t t = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    const package::SurfaceRecord& surface = tile.surfaces[run.surface];
    for (; t < run.end; ++t) {
      const CellFace face = face_of(tile, tile.mesh.triangles[t], surface, shift_m);
      if (face.normal != Point3d{}) visit(face, surface.kind());
    }
  }
}

void add_walls_at_border(const PackageReader& package, Cell cell, Cell neighbor, CellFaces& faces) {
  const Grid& grid = package.grid();
  const double edge_m = grid.cell_edge_m;
  for_each_face(package.tile(neighbor), grid.corner_of(neighbor) - grid.corner_of(cell),
                [&](const CellFace& f, SurfaceKind kind) {
                  const bool is_at_border = f.low.x <= edge_m + party_wall_m && -party_wall_m <= f.high.x &&
                                            f.low.y <= edge_m + party_wall_m && -party_wall_m <= f.high.y;
                  if (kind == SurfaceKind::wall && is_at_border) faces.walls_at_border.push_back(f);
                });
}

}  // namespace

CellFaces faces_of(const PackageReader& package, Cell cell) {
  CellFaces faces;
  for_each_face(package.tile(cell), {}, [&](const CellFace& face, SurfaceKind kind) {
    if (kind == SurfaceKind::roof) faces.roofs.push_back(face);
    if (kind == SurfaceKind::wall) faces.walls.push_back(face);
    if (kind == SurfaceKind::ground) faces.ground.push_back(face);
  });
  for (std::int32_t j = cell.j - 1; j <= cell.j + 1; ++j)
    for (std::int32_t i = cell.i - 1; i <= cell.i + 1; ++i)
      if (const Cell there{i, j}; there != cell && package.grid().cells.contains(there))
        add_walls_at_border(package, cell, there, faces);
  return faces;
}

}  // namespace farlod
