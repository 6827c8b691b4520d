// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/seen_surfaces.hpp"

#include <cmath>
#include <numbers>

#include "base/cancellation.hpp"
#include "base/frame.hpp"
#include "farlod/surface_kind.hpp"

namespace farlod {
namespace {

ViewClass wall_facing(const Point3f& side, const package::Manifest& manifest) {
  // true azimuth = grid azimuth + convergence
  const Angle azimuth = azimuth_of(manifest.grid.rotation.city_from_grid(Point2d{side.x, side.y})) + manifest.convergence;
  constexpr auto slices = static_cast<int>(wall_slices);
  const auto slice = static_cast<int>(std::floor(azimuth.radians() / (2.0 * std::numbers::pi / slices)));
  const int wrapped = ((slice % slices) + slices) % slices;
  return static_cast<ViewClass>(static_cast<int>(ViewClass::first_wall) + wrapped);
}

/// The class of a side of a building's surface, which looks there.
ViewClass class_of(SurfaceKind kind, const Point3f& side, const package::Manifest& manifest) {
  constexpr auto steep = static_cast<float>(wall_normal_z);
  if (side.z <= -steep) return ViewClass::other;
  const bool is_level = std::hypot(side.x, side.y) < steep, is_terrace = kind == SurfaceKind::floor && side.z >= steep;
  return kind == SurfaceKind::roof || is_level || is_terrace ? ViewClass::roof : wall_facing(side, manifest);
}

}  // namespace

SeenSurfaces::SeenSurfaces(const PackageReader& package, const std::stop_token& stop) : sides_(1) {
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    throw_if_cancelled(stop);
    add(package.manifest(), package.tile(cells.cell_at(n)));
  }
  sides_of_triangle_.resize(sides_of_triangle_.size() + package.far_terrain().triangles.size());
}

void SeenSurfaces::add(const package::Manifest& manifest, const TileView& tile) {
  std::uint32_t begin = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    const package::SurfaceRecord& surface = tile.surfaces[run.surface];
    if (surface.kind() == SurfaceKind::ground) {
      add_ground(manifest, tile.mesh, begin, run.end);
    } else {
      const Point3f front = surface.normal().direction(), back{-front.x, -front.y, -front.z};
      const std::uint32_t sides =
          added({front, class_of(surface.kind(), front, manifest), class_of(surface.kind(), back, manifest)});
      sides_of_triangle_.insert(sides_of_triangle_.end(), run.end - begin, sides);
    }
    begin = run.end;
  }
}

void SeenSurfaces::add_ground(const package::Manifest& manifest, const MeshView& mesh, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t n = begin; n < end; ++n) {
    const Triangle& t = mesh.triangles[n];
    const auto corner = [&](std::uint32_t number) {
      const Point3f& p = mesh.vertices[number];
      return Point3d{p.x, p.y, p.z};
    };
    const Point3d a = corner(t.a), normal = normalized(cross(corner(t.b) - a, corner(t.c) - a));
    // One without an area has no normal, and no ray meets it
    const bool is_steep = std::abs(normal.z) < wall_normal_z && !(normal == Point3d{});
    const Point3f front{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)};
    const Point3f back{-front.x, -front.y, -front.z};
    sides_of_triangle_.push_back(is_steep ? added({front, wall_facing(front, manifest), wall_facing(back, manifest)}) : 0);
  }
}

}  // namespace farlod
