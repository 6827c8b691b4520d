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
#include "tiles/building_bases.hpp"
#include "tiles/ground.hpp"
#include "tiles/tiles.hpp"
#include "tiles/undersides.hpp"

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
  CitySettings settings{.size_m = 300.0, .lod = 2};
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

const GroundHeightAt level_ground = [](Point2d) { return 0.0; };

/// A wall above the x axis, or above a line that is turned from it.
Face wall(double x0, double x1, double low_m, double high_m) {
  return {{x0, 0, low_m}, {x1, 0, low_m}, {x1, 0, high_m}, {x0, 0, high_m}};
}
const Face gable{{0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {5, 0, 9}, {0, 0, 6}};

/// The heights of a wall's borders by place in the plan; which end it begins at means nothing.
double lower_at(const WallProfile& wall, double x) { return wall.lower_m(norm(Point2d{x, 0.0} - wall.begin)); }
double upper_at(const WallProfile& wall, double x) { return wall.upper_m(norm(Point2d{x, 0.0} - wall.begin)); }

GroundedWalls walls_of(const std::vector<Face>& faces, const GroundHeightAt& ground = level_ground) {
  std::vector<WallProfile> walls;
  for (const Face& face : faces) {
    auto profile = wall_profile(face);
    EXPECT_TRUE(profile);
    if (profile) walls.push_back(std::move(*profile));
  }
  return {std::move(walls), ground};
}

Segment3d level_segment(double x0, double x1, double z) { return {{x0, 0, z}, {x1, 0, z}}; }

TEST(WallProfile, OfARectangle) {
  const auto profile = wall_profile(wall(2, 12, 1, 7));
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->length_m, 10.0);
  for (const double x : {2.0, 5.0, 12.0}) {
    EXPECT_EQ(lower_at(*profile, x), 1.0);
    EXPECT_EQ(upper_at(*profile, x), 7.0);
  }
}

TEST(WallProfile, OfAGable) {
  for (Face face : {gable, Face(gable.rbegin(), gable.rend())}) {
    const auto profile = wall_profile(face);
    ASSERT_TRUE(profile);
    for (const double x : {0.0, 1.0, 5.0, 8.0, 10.0}) {
      EXPECT_NEAR(lower_at(*profile, x), 0.0, 1e-12);
      EXPECT_NEAR(upper_at(*profile, x), 9.0 - 0.6 * std::abs(x - 5.0), 1e-12);
    }
  }
}

TEST(WallProfile, DoesNotDependOnTheFirstPointOfTheRing) {
  Face face = gable;
  for (std::size_t turn = 0; turn < gable.size(); ++turn) {
    std::rotate(face.begin(), face.begin() + 1, face.end());
    const auto profile = wall_profile(face);
    ASSERT_TRUE(profile);
    for (const double x : {0.5, 3.0, 9.0}) EXPECT_NEAR(upper_at(*profile, x), 9.0 - 0.6 * std::abs(x - 5.0), 1e-12);
  }
}

TEST(WallProfile, OfAWallWithADoorStepsUpBelow) {
  const auto profile =
      wall_profile(Face{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {6, 0, 2}, {6, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}});
  ASSERT_TRUE(profile);
  EXPECT_EQ(lower_at(*profile, 2), 0.0);
  EXPECT_EQ(lower_at(*profile, 5), 2.0);
  EXPECT_EQ(lower_at(*profile, 4), 2.0) << "at a step, the higher one";
}

TEST(WallProfile, OfSteppedGablesStepsAbove) {
  const auto profile =
      wall_profile(Face{{0, 0, 0}, {10, 0, 0}, {10, 0, 4}, {7, 0, 4}, {7, 0, 8}, {3, 0, 8}, {3, 0, 4}, {0, 0, 4}});
  ASSERT_TRUE(profile);
  EXPECT_EQ(upper_at(*profile, 5), 8.0);
  EXPECT_EQ(upper_at(*profile, 1), 4.0);
  EXPECT_EQ(upper_at(*profile, 3), 4.0) << "at a step, the lower one";
}

TEST(WallProfile, OfNothingElse) {
  EXPECT_FALSE(wall_profile(Face{{0, 0, 0}, {10, 0, 0}, {10, 1, 5}, {0, 1, 5}})) << "it leans";
  EXPECT_FALSE(wall_profile(Face{{0, 0, 5}, {10, 0, 5}, {10, 8, 5}, {0, 8, 5}})) << "a roof";
  EXPECT_FALSE(wall_profile(Face{{3, 3, 0}, {3, 3, 5}, {3, 3, 9}})) << "a line";
  EXPECT_FALSE(wall_profile(Face{{0, 0, 0}, {10, 0, 0}})) << "no facet";
  // A C: upright lines meet it twice
  EXPECT_FALSE(wall_profile(Face{{0, 0, 0}, {10, 0, 0}, {10, 0, 2}, {3, 0, 2}, {3, 0, 6}, {10, 0, 6}, {10, 0, 8}, {0, 0, 8}}));
}

TEST(GroundedWalls, ARectangularWallClosesItsUpperBorderAndAllBelow) {
  const GroundedWalls walls = walls_of({wall(0, 10, 0, 6)});
  EXPECT_TRUE(walls.close_below(level_segment(0, 10, 6)));
  EXPECT_TRUE(walls.close_below(level_segment(10, 0, 6)));
  EXPECT_TRUE(walls.close_below(level_segment(3, 4, 6)));
  EXPECT_TRUE(walls.close_below(level_segment(3, 4, 2)));
  EXPECT_FALSE(walls.close_below(level_segment(0, 10, 6.1)));
  EXPECT_FALSE(walls.close_below({{0, 0, 6}, {10, 0, 6.1}}));
  EXPECT_FALSE(walls.close_below(level_segment(0, 11, 6))) << "it reaches beyond the wall";
  EXPECT_FALSE(walls.close_below({{0, 0, 6}, {0, 8, 6}})) << "it leaves the wall";
  EXPECT_FALSE(walls.close_below({{0, 1, 6}, {10, 1, 6}})) << "it lies beside the wall";
}

TEST(GroundedWalls, AGableClosesItsSlopesAndNoTieAboveThem) {
  const GroundedWalls walls = walls_of({gable});
  EXPECT_TRUE(walls.close_below({{0, 0, 6}, {5, 0, 9}}));
  EXPECT_TRUE(walls.close_below({{5, 0, 9}, {10, 0, 6}}));
  EXPECT_TRUE(walls.close_below(level_segment(0, 10, 6)));
  EXPECT_FALSE(walls.close_below(level_segment(0, 10, 8)));
  // Both ends lie on the wall, the middle does not
  const GroundedWalls notched = walls_of({{{0, 0, 0}, {10, 0, 0}, {10, 0, 9}, {5, 0, 4}, {0, 0, 9}}});
  EXPECT_FALSE(notched.close_below(level_segment(0, 10, 9)));
  EXPECT_TRUE(notched.close_below({{0, 0, 9}, {5, 0, 4}}));
}

TEST(GroundedWalls, AWallOnAWallIsGrounded) {
  const Face lower = wall(0, 10, 0, 3), middle = wall(2, 9, 3, 6), upper = wall(4, 8, 6, 9);
  for (const auto& faces : {std::vector<Face>{lower, middle, upper}, {upper, middle, lower}, {middle, upper, lower}})
    EXPECT_TRUE(walls_of(faces).close_below(level_segment(4, 8, 9)));
  EXPECT_FALSE(walls_of({lower, upper}).close_below(level_segment(4, 8, 9))) << "there is a gap between them";
  EXPECT_FALSE(walls_of({middle, upper}).close_below(level_segment(4, 8, 9))) << "the lowest one floats";
}

TEST(GroundedWalls, AWallMayStandOnSeveral) {
  EXPECT_TRUE(walls_of({wall(0, 5, 0, 3), wall(5, 10, 0, 3), wall(0, 10, 3, 6)}).close_below(level_segment(0, 10, 6)));
  EXPECT_FALSE(walls_of({wall(0, 4, 0, 3), wall(6, 10, 0, 3), wall(0, 10, 3, 6)}).close_below(level_segment(0, 10, 6)))
      << "between them it can be seen under";
}

TEST(GroundedWalls, AWallAboveASoffitIsNot) {
  const GroundedWalls walls = walls_of({wall(0, 10, 3, 6)});
  EXPECT_FALSE(walls.close_below(level_segment(0, 10, 6)));
  // A wall with a door is seen through
  const GroundedWalls door =
      walls_of({{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {6, 0, 2}, {6, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}}});
  EXPECT_FALSE(door.close_below(level_segment(0, 10, 5)));
}

TEST(GroundedWalls, FollowTheGround) {
  const GroundHeightAt slope = [](Point2d p) { return 0.2 * p.x; };
  EXPECT_TRUE(walls_of({{{0, 0, 0}, {10, 0, 2}, {10, 0, 6}, {0, 0, 6}}}, slope).close_below(level_segment(0, 10, 6)));
  EXPECT_TRUE(walls_of({wall(0, 10, 0, 6)}, slope).close_below(level_segment(0, 10, 6))) << "dug in";
  EXPECT_FALSE(walls_of({wall(0, 10, 2, 6)}, slope).close_below(level_segment(0, 10, 6)));
  EXPECT_TRUE(walls_of({wall(0, 10, 0.9 * ground_contact_m, 6)}).close_below(level_segment(0, 10, 6)));
  // A hollow as wide as the ground is asked
  const GroundHeightAt hollow = [](Point2d p) { return std::abs(p.x - 5.3) < 0.6 * ground_sampling_step_m ? -1.0 : 0.0; };
  EXPECT_FALSE(walls_of({wall(0, 10, 0, 6)}, hollow).close_below(level_segment(0, 10, 6)));
}

// The whole tile stage

TEST(GroundedWalls, OfAHouseWithAProjectingFloorKeepTheEdgesAboveThemGrounded) {
  test::SmallTown town;
  // The upper floor projects by 2 m to the south; the north wall reaches the ground, the side walls do so in part
  town.add("house", {{{10, 8, 6}, {20, 8, 6}, {20, 20, 6}, {10, 20, 6}},
                     {{10, 8, 3}, {10, 10, 3}, {20, 10, 3}, {20, 8, 3}},
                     {{10, 10, 0}, {20, 10, 0}, {20, 10, 3}, {10, 10, 3}},
                     {{10, 8, 3}, {20, 8, 3}, {20, 8, 6}, {10, 8, 6}},
                     {{20, 20, 0}, {10, 20, 0}, {10, 20, 6}, {20, 20, 6}},
                     {{20, 10, 0}, {20, 20, 0}, {20, 20, 6}, {20, 8, 6}, {20, 8, 3}, {20, 10, 3}},
                     {{10, 20, 0}, {10, 10, 0}, {10, 10, 3}, {10, 8, 3}, {10, 8, 6}, {10, 20, 6}}});
  const TileSet tiles = town.tiles();
  // The wall below the soffit hides all that is below its upper border
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::grounded), test::as_set({{{10, 20, 6}, {20, 20, 6}}, {{10, 10, 3}, {20, 10, 3}}}));
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::overhang),
            test::as_set({{{10, 8, 6}, {20, 8, 6}}, {{10, 8, 6}, {10, 20, 6}}, {{20, 8, 6}, {20, 20, 6}}}));
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::underside),
            test::as_set({{{10, 8, 3}, {20, 8, 3}}, {{10, 8, 3}, {10, 10, 3}}, {{20, 8, 3}, {20, 10, 3}}}));
}

TEST(GroundedWalls, OfAnOpenShellKeepThreeEdgesOfItsRoofGrounded) {
  test::SmallTown town;
  auto shell = test::box(10, 10, 20, 20, 0, 5);
  shell.erase(shell.begin() + 1);  // the south wall
  town.add("shell", shell);
  const TileSet tiles = town.tiles();
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::grounded).size(), 3U);
  const std::vector<Segment3d> front{{{10, 10, 5}, {20, 10, 5}}};
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::overhang), front);
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::underside), front);
}

}  // namespace
}  // namespace farlod::tiles
