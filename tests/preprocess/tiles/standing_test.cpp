// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/determinism/threads.hpp"
#include "tests/preprocess/tiles/bodies.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/tiles.hpp"

namespace farlod {
namespace {

using test::Face;

TileSet tiles_of(const CityModel& city, Assign assign = Assign::clip) {
  Report ignored;
  return cut_into_tiles({city, {}}, scenes::grid_covering(city, {}, 50, 3), assign, {}, ignored);
}

/// Whether one body stands, beside a house that says where the ground is.
bool stands(const std::vector<Face>& faces) {
  CityModel city;
  test::add_building(city, "neighbour", test::box(15, 10, 19, 20, 0, 3));
  test::add_building(city, "body", faces);
  const TileSet tiles = tiles_of(city);
  std::set<bool> verdicts;
  for (const Surface& s : tiles.surfaces)
    if (s.building == 1) verdicts.insert(s.stands);
  EXPECT_EQ(verdicts.size(), 1U) << "a building stands whole or not at all";
  return *verdicts.begin();
}

std::size_t edge_count(const TileSet& tiles) {
  std::size_t count = 0;
  for (const Tile& tile : tiles.tiles) count += tile.horizon_edges.size();
  return count;
}

TEST(Standing, AreSolidsWithOrWithoutAFloor) {
  EXPECT_TRUE(stands(test::gabled_house()));
  EXPECT_TRUE(stands(test::stepped_box()));
  auto without_floor = test::gabled_house();
  without_floor.pop_back();
  EXPECT_TRUE(stands(without_floor));
}

TEST(Standing, AreSolidsWhoseFacesMeetInTJunctions) { EXPECT_TRUE(stands(test::box_with_t_junctions())); }

TEST(Standing, AreNeitherShellsNorBridgesNorEaves) {
  auto shell = test::box(0, 0, 10, 20, 0, 5);
  shell.erase(shell.begin() + 1);  // the south wall
  EXPECT_FALSE(stands(shell));
  EXPECT_FALSE(stands(test::box(0, 0, 10, 20, 4, 7)));
  auto house_with_eaves = test::box(0, 0, 10, 20, 0, 5);
  house_with_eaves.push_back({{-1, 0, 5}, {0, 0, 5}, {0, 20, 5}, {-1, 20, 5}});
  EXPECT_FALSE(stands(house_with_eaves));
}

TEST(Standing, OnlyWhatStandsGivesHorizonEdges) {
  CityModel city;
  test::add_building(city, "house", test::box(1, 1, 49, 20, 0, 12));
  const std::size_t ground_and_house = edge_count(tiles_of(city));
  EXPECT_EQ(ground_and_house, 4U + 4U);  // one cell, whose border no piece crosses
  test::add_building(city, "bridge", test::box(10, 20, 15, 40, 4, 7));
  EXPECT_EQ(edge_count(tiles_of(city)), ground_and_house);
}

TEST(Standing, AssignWholeKeepsAllEdgesOfABuildingInOneCell) {
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

TEST(Standing, HorizonEdgesDoNotDependOnTheNumberOfThreads) {
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

TEST(Standing, ATerrainAloneHasItsBorderAndItsRidges) {
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

TEST(Standing, ATerrainThatTheGridCutsOffEndsAtTheCut) {
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
}  // namespace farlod
