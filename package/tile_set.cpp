// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/tile_set.hpp"

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

void TilePages::let_go() const {
  vertices.let_go();
  triangles.let_go();
  triangle_surfaces.let_go();
  horizon_edges.let_go();
}

std::uint64_t TileSet::triangle_count() const {
  std::uint64_t count = 2 * squares_of_readers;
  for (const Tile& tile : tiles) count += tile.stored_triangles().size();
  return count;
}

namespace {

/// Lets go of what lies in `all` between the first and the last element that the tiles of a block view.
template <class T>
void let_go_of(const PagedArray<T>& all, const TileSet& tiles, const CellRange& block, TileArray<T> Tile::*elements) {
  std::size_t begin = all.size(), end = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(block.size()); ++n) {
    const TileArray<T>& viewed = tiles.tile(block.cell_at(n)).*elements;
    if (viewed.empty()) continue;
    const auto first = static_cast<std::size_t>(viewed.data() - all.data());
    begin = std::min(begin, first);
    end = std::max(end, first + viewed.size());
  }
  if (begin < end) all.let_go(begin, end);
}

}  // namespace

void TileSet::let_go(const CellRange& block) const {
  surfaces.let_go();
  if (!pages) return;
  let_go_of(pages->vertices, *this, block, &Tile::vertices);
  let_go_of(pages->triangles, *this, block, &Tile::triangles);
  let_go_of(pages->triangle_surfaces, *this, block, &Tile::triangle_surfaces);
  let_go_of(pages->horizon_edges, *this, block, &Tile::horizon_edges);
}

void TileSet::let_go() const {
  surfaces.let_go();
  if (pages) pages->let_go();
}

}  // namespace farlod
