// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/whole_city_rival.hpp"

namespace farlod::benchmark {

CityTriangles triangles_of(const PackageReader& package) {
  const Grid& grid = package.grid();
  CityTriangles city;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    const Cell cell = grid.cells.cell_at(n);
    const MeshView mesh = package.tile(cell).mesh;
    const Point2d shift_m = grid.corner_of(cell) - grid.middle_corner();
    const auto first = static_cast<std::uint32_t>(city.vertices.size());
    for (const Point3f& p : mesh.vertices)
      city.vertices.push_back({static_cast<float>(p.x + shift_m.x), static_cast<float>(p.y + shift_m.y), p.z});
    for (const Triangle& t : mesh.triangles) city.triangles.push_back({t.a + first, t.b + first, t.c + first});
  }
  // Embree reads the last vertex as 16 bytes
  city.vertices.push_back({});
  return city;
}

}  // namespace farlod::benchmark
