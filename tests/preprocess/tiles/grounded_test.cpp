// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/determinism/threads.hpp"
#include "tests/preprocess/tiles/borders.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/base_points.hpp"
#include "tiles/ground.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles {
namespace {

using test::Face;

TileSet tiles_of(const CityModel& city, Assign assign = Assign::clip) {
  Report ignored;
  return cut_into_tiles({city, {}}, scenes::grid_covering(city, {}, 50, 3), assign, {}, ignored);
}

/// Whether one body is grounded, on level ground.
bool is_grounded(const std::vector<Face>& faces) {
  test::SmallTown town;
  town.add("body", faces);
  return test::is_grounded(town.tiles(), 1);
}

/// Of all tiles, how many edges above the ground have each role.
std::array<std::size_t, edge_role_count> edge_counts(const TileSet& tiles) {
  std::array<std::size_t, edge_role_count> counts{};
  for (const Tile& tile : tiles.tiles)
    for (const HorizonEdge& e : tile.horizon_edges)
      if (std::max(e.a.z, e.b.z) > 0.1F) ++counts.at(static_cast<std::size_t>(e.role));
  return counts;
}

TEST(Grounded, AreSolidsWithOrWithoutAFloor) {
  EXPECT_TRUE(is_grounded(test::gabled_house()));
  EXPECT_TRUE(is_grounded(test::stepped_box()));
  auto without_floor = test::gabled_house();
  without_floor.pop_back();
  EXPECT_TRUE(is_grounded(without_floor));
}

TEST(Grounded, AreSolidsWhoseFacesMeetInTJunctions) { EXPECT_TRUE(is_grounded(test::box_with_t_junctions())); }

TEST(Grounded, AreSheetsThatReachTheGround) {
  EXPECT_TRUE(is_grounded({{{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}}})) << "a wall";
}

TEST(Grounded, AreNeitherOpenShellsNorBridgesNorEaves) {
  auto shell = test::box(0, 0, 10, 20, 0, 5);
  shell.erase(shell.begin() + 1);  // the south wall
  EXPECT_FALSE(is_grounded(shell));
  EXPECT_FALSE(is_grounded(test::box(0, 0, 10, 20, 4, 7)));
  auto house_with_eaves = test::box(0, 0, 10, 20, 0, 5);
  house_with_eaves.push_back({{-1, 0, 5}, {0, 0, 5}, {0, 20, 5}, {-1, 20, 5}});
  EXPECT_FALSE(is_grounded(house_with_eaves));
  EXPECT_FALSE(is_grounded({{{0, 0, 0}, {10, 0, 0}, {10, 4, 5}, {0, 4, 5}}, {{10, 4, 5}, {10, 8, 0}, {0, 8, 0}, {0, 4, 5}}}))
      << "a tent with open ends";
}

TEST(Grounded, WithinTheAccuracyOfTerrains) {
  EXPECT_TRUE(is_grounded(test::box(0, 0, 10, 10, 0.9 * ground_contact_m, 7)));
  EXPECT_TRUE(is_grounded(test::box(0, 0, 10, 10, 1.2 * ground_contact_m, 7))) << "a foundation closes what is more";
  EXPECT_FALSE(is_grounded(test::box(0, 0, 10, 10, 1.1 * least_clearance_m, 7))) << "one can walk under it";
  EXPECT_TRUE(is_grounded(test::box(0, 0, 10, 10, -3, 7))) << "its foot is below the ground";
}

TEST(Grounded, OverAHollowSomethingThatReachesItsRimsIsNot) {
  // Ground that dips by 4 m between x = 10 and 30, and a bridge from rim to rim
  TerrainRaster terrain{{-25, -25}, {5, 5}, 21, 21, {}};
  for (std::size_t n = 0; n < 21 * 21; ++n) {
    const double x = -25.0 + 5.0 * static_cast<double>(n % 21);
    terrain.height_m.emplace_back(x > 10.0 && x < 30.0 ? 1.0F : 5.0F);
  }
  CityModel city;
  test::add_building(city, "bridge", test::box(5, 5, 35, 9, 5, 6));
  Report ignored;
  const TileSet tiles = cut_into_tiles({city, {}}, scenes::grid_covering(city, {}, 50, 3), Assign::clip, terrain, ignored);
  EXPECT_FALSE(test::is_grounded(tiles, 0));
  // Both sides are open over the hollow alone, to the next place at which the ground is looked at
  double open_m = 0.0;
  for (const HorizonEdge& e : tiles.tile({0, 0}).horizon_edges)
    if (e.role == EdgeRole::underside) open_m += std::abs(e.b.x - e.a.x);
  EXPECT_NEAR(open_m, 2.0 * 20.0, 4.0 * ground_sampling_step_m);
}

TEST(Grounded, RolesOfEdgesFollow) {
  test::SmallTown town;
  town.add("house", test::box(1, 1, 49, 20, 0, 12));
  EXPECT_EQ(edge_counts(town.tiles()), (std::array<std::size_t, 3>{4, 0, 0}));
  town.add("bridge", test::box(10, 25, 15, 40, 4, 7));
  const TileSet tiles = town.tiles();
  EXPECT_EQ(edge_counts(tiles), (std::array<std::size_t, 3>{4, 4, 4}));
}

TEST(Grounded, AssignWholeKeepsAllEdgesOfABuildingInOneCell) {
  CityModel city;
  test::add_building(city, "house", test::box(40, 10, 90, 20, 0, 12));  // its centroid is at x = 65
  const TileSet clipped = tiles_of(city), whole = tiles_of(city, Assign::whole);
  const auto high_edges = [](const Tile& tile) {
    return std::count_if(tile.horizon_edges.begin(), tile.horizon_edges.end(), [](const HorizonEdge& e) { return e.a.z > 0.0F; });
  };
  EXPECT_EQ(high_edges(clipped.tile({0, 0})), 3);
  EXPECT_EQ(high_edges(clipped.tile({1, 0})), 3);
  EXPECT_EQ(high_edges(whole.tile({0, 0})), 0);
  EXPECT_EQ(high_edges(whole.tile({1, 0})), 4);
}

TEST(Grounded, HorizonEdgesDoNotDependOnTheNumberOfThreads) {
  CitySettings settings;
  settings.size_m = 300.0;
  settings.lod = 2;
  const CityModel city = scenes::generated_town(settings);
  const TileSet there = with_threads(1, [&] { return tiles_of(city); });
  for (int n = 0; n < repeats; ++n) {
    const TileSet here = with_threads(many_threads, [&] { return tiles_of(city); });
    for (std::size_t t = 0; t < here.tiles.size(); ++t) EXPECT_EQ(here.tiles[t].horizon_edges, there.tiles[t].horizon_edges) << t;
  }
}

TEST(Grounded, ATerrainAloneHasItsBorderAndItsRidges) {
  // A ridge along y = 20 that rises to 3 m, known between 5 and 45 m
  TerrainRaster terrain{{5, 5}, {5, 5}, 9, 9, {}};
  for (std::size_t n = 0; n < 81; ++n) terrain.height_m.emplace_back(n / 9 == 3 ? 3.0F : 0.0F);
  Grid grid;
  grid.cells = {0, 0, 1, 1};
  Report ignored;
  const TileSet tiles = cut_into_tiles({}, grid, Assign::clip, terrain, ignored);
  const auto& edges = tiles.tiles[0].horizon_edges;
  EXPECT_EQ(std::count_if(edges.begin(), edges.end(), [](const HorizonEdge& e) { return e.a.z == 3.0F && e.b.z == 3.0F; }), 8);
  EXPECT_EQ(edges.size(), 8U + 32U);  // the ridge and the border, node by node; neither the feet nor the diagonals
}

TEST(Grounded, ATerrainThatTheGridCutsOffEndsAtTheCut) {
  // A valley along x = 25 whose slopes go on rising beyond the one cell of the grid
  TerrainRaster terrain{{-25, -25}, {50, 25}, 3, 5, {}};
  for (std::size_t n = 0; n < 15; ++n) terrain.height_m.emplace_back(n % 3 == 1 ? 0.0F : 10.0F);
  Grid grid;
  grid.cells = {0, 0, 1, 1};
  Report ignored;
  const TileSet tiles = cut_into_tiles({}, grid, Assign::clip, terrain, ignored);
  double east_m = 0.0, west_m = 0.0, sides_m = 0.0;
  for (const HorizonEdge& e : tiles.tiles[0].horizon_edges) {
    if (e.a.x == 50.0F && e.b.x == 50.0F) east_m += std::abs(e.b.y - e.a.y);
    if (e.a.x == 0.0F && e.b.x == 0.0F) west_m += std::abs(e.b.y - e.a.y);
    if (e.a.x != e.b.x) sides_m += std::abs(e.b.x - e.a.x);
  }
  EXPECT_EQ(east_m, 50.0);
  EXPECT_EQ(west_m, 50.0);
  EXPECT_EQ(sides_m, 2 * 50.0);  // the cuts in the south and in the north, and no diagonal
}

}  // namespace
}  // namespace farlod::tiles
