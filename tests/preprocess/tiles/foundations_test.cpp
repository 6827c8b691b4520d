// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/foundations.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/scene_builder.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles {
namespace {

Grid one_cell() {
  Grid grid;
  grid.cell_edge_m = 128.0;
  grid.cells = {0, 0, 1, 1};
  return grid;
}

/// A house of 10 m by 10 m whose base is at this height, above a plain at 0.
TileSet house_over_plain(double base_m, double height_m = 10.0) {
  scenes::SceneBuilder town;
  town.add_box({{40, 40}, {50, 50}}, base_m, base_m + height_m);
  LocatedCity city;
  city.city = town.city();
  TerrainRaster plain;
  plain.first = {-10.0, -10.0};
  plain.columns = plain.rows = 2;
  plain.step_m = {200.0, 200.0};
  plain.height_m.assign(4, 0.0F);
  Report report;
  return cut_into_tiles(std::move(city), one_cell(), Assign::clip, plain, report);
}

std::size_t edges_of(const TileSet& tiles, EdgeRole role) {
  const auto& edges = tiles.tiles[0].horizon_edges;
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [role](const HorizonEdge& e) { return e.role == role; }));
}

double area_of(const TileSet& tiles, SurfaceKind kind) {
  const Tile& tile = tiles.tiles[0];
  double area_m2 = 0.0;
  for (std::size_t n = 0; n < tile.triangles.size(); ++n) {
    if (tiles.surfaces[tile.triangle_surfaces[n]].kind != kind) continue;
    const Triangle& t = tile.triangles[n];
    const Point3f a = tile.vertices[t.a];
    area_m2 += 0.5 * norm(cross(tile.vertices[t.b] - a, tile.vertices[t.c] - a));
  }
  return area_m2;
}

TEST(Foundations, AHouseOnTheGroundNeedsNone) {
  const TileSet tiles = house_over_plain(0.0);
  EXPECT_EQ(tiles.foundation_count, 0U);
  EXPECT_EQ(area_of(tiles, SurfaceKind::foundation), 0.0);
  EXPECT_EQ(edges_of(tiles, EdgeRole::underside), 0U);
}

TEST(Foundations, CloseAFloorThatFloats) {
  const TileSet tiles = house_over_plain(2.0);
  EXPECT_EQ(tiles.foundation_count, 1U);
  EXPECT_EQ(edges_of(tiles, EdgeRole::underside), 0U) << "nothing is seen below the house";
  EXPECT_EQ(edges_of(tiles, EdgeRole::overhang), 0U);
  // Four walls of 10 m, from the floor at 2 m to a little below the ground, and the floor again as their lid
  EXPECT_GT(area_of(tiles, SurfaceKind::foundation), 4 * 10.0 * 2.0 + 100.0);
  for (const Surface& s : tiles.surfaces) EXPECT_TRUE(s.grounded);
  const Surface& foundation = tiles.surfaces.back();
  ASSERT_EQ(foundation.kind, SurfaceKind::foundation);
  EXPECT_DOUBLE_EQ(foundation.area_m2, area_of(tiles, SurfaceKind::foundation));
}

TEST(Foundations, WhatOneCanWalkUnderFromAllSidesGetsNone) {
  const TileSet tiles = house_over_plain(4.0);
  EXPECT_EQ(tiles.foundation_count, 0U);
  EXPECT_GT(edges_of(tiles, EdgeRole::underside), 0U);
}

TEST(Foundations, WhatIsThinnerThanTheGapBelowItGetsNone) {
  EXPECT_EQ(house_over_plain(2.0, 2.1).foundation_count, 1U);
  const TileSet tiles = house_over_plain(2.0, 1.9);
  EXPECT_EQ(tiles.foundation_count, 0U);
  EXPECT_GT(edges_of(tiles, EdgeRole::underside), 0U);
}

TEST(Foundations, WallsReachBelowTheGroundAllAlong) {
  const HorizonSegment border{{{0, 0, 5}, {10, 0, 5}}, {}, EdgeRole::underside};
  // A trough in the middle of the border
  const auto ground = [](Point2d p) { return p.x > 4.0 && p.x < 6.0 ? -3.0 : 4.0; };
  const auto walls = foundation_walls({&border, 1}, ground);
  ASSERT_EQ(walls.size(), 2U);
  double lowest_m = 5.0;
  for (const auto& triangle : walls)
    for (const Point3d& p : triangle) lowest_m = std::min(lowest_m, p.z);
  EXPECT_LT(lowest_m, -3.0);
}

}  // namespace
}  // namespace farlod::tiles
