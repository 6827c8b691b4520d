// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "farlod/grid.hpp"
#include "farlod/horizon/edge_facing.hpp"
#include "farmap/baked_block.hpp"
#include "tests/preprocess/farmap/sight.hpp"
#include "tiles/tile_set.hpp"

namespace farlod::test {

/// What can hide the sky in the far city of a cell (frame of that cell), and how a block would store it if it were named.
struct FarThing {
  bool is_edge = true;
  std::array<Point3d, 3> corners;              ///< of an edge, the third repeats the second
  std::array<std::array<float, 3>, 3> stored;  ///< the same in the frame of the block's south-west cell
  EdgeRises rises = {};                        ///< of an edge
  auto operator<=>(const FarThing& o) const { return std::pair(is_edge, stored) <=> std::pair(o.is_edge, o.stored); }
};

/// Everything outside of a cell's neighbourhood, tile by tile: horizon edges, and the triangles of what does not stand.
[[nodiscard]] inline std::vector<FarThing> far_city(const TileSet& tiles, const Grid& grid, Cell cell) {
  const Point2d block_corner = grid.corner_of(grid.cells_of(grid.block_of(cell)).cell_at(0));
  std::vector<FarThing> things;
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    const Cell place = tiles.cells.cell_at(n);
    if (grid.neighborhood_of(cell).contains(place)) continue;
    const Point2d shift = grid.corner_of(place) - grid.corner_of(cell), in_block = grid.corner_of(place) - block_corner;
    const auto add = [&](bool is_edge, const std::array<Point3f, 3>& p, EdgeRises rises) {
      FarThing thing{is_edge, {}, {}, rises};
      for (std::size_t k = 0; k < 3; ++k) {
        thing.corners[k] = {p[k].x + shift.x, p[k].y + shift.y, p[k].z};
        thing.stored[k] = {static_cast<float>(p[k].x + in_block.x), static_cast<float>(p[k].y + in_block.y), p[k].z};
      }
      things.push_back(thing);
    };
    const Tile& tile = tiles.tiles[n];
    for (const HorizonEdge& e : tile.horizon_edges) add(true, {e.a, e.b, e.b}, e.rises);
    for (std::size_t t = 0; t < tile.triangles.size(); ++t)
      if (!tiles.surfaces[tile.triangle_surfaces[t]].stands)
        add(false, {tile.vertices[tile.triangles[t].a], tile.vertices[tile.triangles[t].b], tile.vertices[tile.triangles[t].c]},
            {});
  }
  return things;
}

/// Whether an edge is no horizon for anybody in a cell: what hides it from them is there by other edges.
[[nodiscard]] inline bool faces_away(const FarThing& thing, const BakedHorizon& map, double cell_edge_m) {
  const auto& [a, b, c] = thing.corners;
  return thing.is_edge && !may_be_horizon(a, b, thing.rises, {{0.0, 0.0}, {cell_edge_m, cell_edge_m}},
                                          map.patches.levels_m().front(), std::max(a.z, b.z));
}

/// What a cell's map names for one of its patches.
[[nodiscard]] inline std::set<FarThing> named_in(const BakedHorizons& block, const BakedHorizon& map, std::uint32_t patch) {
  const std::uint32_t square = patch % map.patches.squares(), layer = patch / map.patches.squares();
  const auto stored = [](const Point3f& p) { return std::array<float, 3>{p.x, p.y, p.z}; };
  std::set<FarThing> things;
  for (const package::NamedObstacle& named : map.named_edges) {
    const HorizonEdge& e = block.edges[named.row];
    if (named.matters(square, layer)) things.insert({true, {}, {stored(e.a), stored(e.b), stored(e.b)}});
  }
  for (const package::NamedObstacle& named : map.named_triangles) {
    const package::FarTriangle& t = block.triangles[named.row];
    if (named.matters(square, layer)) things.insert({false, {}, {stored(t[0]), stored(t[1]), stored(t[2])}});
  }
  return things;
}

/// A place in a patch. Of the uppermost, which has no lid, one in its first 40 m.
[[nodiscard]] inline Point3d place_in(const PatchBox& box, Chance& chance) {
  return {chance.between(box.low.x, box.high.x), chance.between(box.low.y, box.high.y),
          chance.between(box.z_low_m, std::min(box.z_high_m, box.z_low_m + 40.0))};
}

}  // namespace farlod::test
