// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/tile_set.hpp"

#include <algorithm>

namespace farlod {

void Tile::add_polygon(const std::vector<Point3f>& polygon, std::uint32_t surface) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const Point3f& p : polygon) {
    vertices.push_back(p);
    z_low_m = std::min(z_low_m, p.z);
    z_high_m = std::max(z_high_m, p.z);
  }
  for (std::uint32_t n = 2; n < polygon.size(); ++n) {
    triangles.push_back({first, first + n - 1, first + n});
    triangle_surfaces.push_back(surface);
  }
}

std::uint64_t TileSet::triangle_count() const {
  std::uint64_t count = 0;
  for (const Tile& tile : tiles) count += tile.triangles.size();
  return count;
}

}  // namespace farlod
