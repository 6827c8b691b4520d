// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <vector>

#include "base/grid.hpp"
#include "package/baked_block.hpp"
#include "package/edge_facing.hpp"
#include "package/tile_set.hpp"
#include "tests/oracles/explicit_in_patch.hpp"
#include "tests/preprocess/farmap/sight.hpp"

namespace farlod::test {

/// An edge of the far city of a cell (frame of that cell), and how a block would store it if it were explicit.
struct FarThing {
  Point3d a, b;
  std::array<std::array<float, 3>, 2> stored;  ///< both ends in the frame of the block's south-west cell
  AdjacentSlopes adjacent = {};
  EdgeRole role = EdgeRole::grounded;

  [[nodiscard]] bool is_upper() const { return role != EdgeRole::underside; }
  auto operator<=>(const FarThing& o) const { return std::tie(role, stored) <=> std::tie(o.role, o.stored); }
};

/// Everything outside of a cell's neighborhood, tile by tile.
[[nodiscard]] inline std::vector<FarThing> far_city(const TileSet& tiles, const Grid& grid, Cell cell) {
  const Point2d block_corner = grid.corner_of(grid.cells_of(grid.block_of(cell)).cell_at(0));
  std::vector<FarThing> things;
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    const Cell place = tiles.cells.cell_at(n);
    if (grid.neighborhood_of(cell).contains(place)) continue;
    const Point2d shift = grid.corner_of(place) - grid.corner_of(cell), in_block = grid.corner_of(place) - block_corner;
    const auto placed = [&](const Point3f& p) { return Point3d{p.x + shift.x, p.y + shift.y, p.z}; };
    const auto stored = [&](const Point3f& p) {
      return std::array<float, 3>{static_cast<float>(p.x + in_block.x), static_cast<float>(p.y + in_block.y), p.z};
    };
    for (const HorizonEdge& e : tiles.tiles[n].horizon_edges)
      things.push_back({placed(e.a), placed(e.b), {stored(e.a), stored(e.b)}, e.adjacent, e.role});
  }
  return things;
}

/// Whether an edge is no silhouette for anybody in a cell: what goes on beyond it is there by other edges.
[[nodiscard]] inline bool faces_away(const FarThing& t, const BakedHorizon& map, double cell_edge_m) {
  return !may_be_silhouette(t.a, t.b, t.adjacent, t.role, {{0.0, 0.0}, {cell_edge_m, cell_edge_m}},
                            map.patches.levels_m().front(), std::max(t.a.z, t.b.z));
}

/// The explicit occluders of a cell's map for one of its patches.
[[nodiscard]] inline std::set<FarThing> explicit_in(const BakedHorizons& block, const BakedHorizon& map, std::uint32_t patch) {
  const auto stored = [](const Point3f& p) { return std::array<float, 3>{p.x, p.y, p.z}; };
  std::set<FarThing> things;
  for (const package::ExplicitOccluder& occluder : map.explicit_edges) {
    const HorizonEdge& e = block.edges[occluder.row];
    if (is_explicit_in(occluder, map.patches, patch)) things.insert({{}, {}, {stored(e.a), stored(e.b)}, e.adjacent, e.role});
  }
  return things;
}

/// A place in a patch. Of the uppermost, which has no lid, one in its first 40 m.
[[nodiscard]] inline Point3d place_in(const PatchBox& box, Chance& chance) {
  return {chance.between(box.low.x, box.high.x), chance.between(box.low.y, box.high.y),
          chance.between(box.z_low_m, std::min(box.z_high_m, box.z_low_m + 40.0))};
}

}  // namespace farlod::test
