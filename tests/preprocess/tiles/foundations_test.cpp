// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/foundations.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>

#include "tests/scenes/scene_builder.hpp"
#include "tiles/crowns_on_ground.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles {
namespace {

using testing::HasSubstr;

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

TEST(Foundations, AFootprintReachesDownToTheGroundWhateverTheGap) {
  for (const double base_m : {2.0, 4.0, 15.0}) {
    scenes::SceneBuilder town;
    town.add_box({{40, 40}, {50, 50}}, base_m, base_m + 10.0);
    std::vector<HorizonSegment> undersides;
    const std::array<Point3d, 4> floor{{{40, 40, base_m}, {50, 40, base_m}, {50, 50, base_m}, {40, 50, base_m}}};
    for (std::size_t k = 0; k < floor.size(); ++k)
      undersides.push_back({{floor[k], floor[(k + 1) % 4]}, {}, EdgeRole::underside});
    const std::vector<HorizonSegment> all = undersides;
    const GroundHeightAt plain = [](Point2d) { return 0.0; };
    const auto foundation = take_foundation(town.city().points(), Foot::on_ground, undersides, plain);
    ASSERT_TRUE(foundation.has_value()) << base_m;
    EXPECT_EQ(foundation->walls.size(), 8U);
    EXPECT_TRUE(undersides.empty());
    undersides = all;
    EXPECT_EQ(take_foundation(town.city().points(), Foot::unsaid, undersides, plain).has_value(), base_m < 2.5) << base_m;
  }
}

TEST(Foundations, ABuildingIsBelowTheGroundByHalfOfItsHeightAtAllItsCorners) {
  const GroundHeightAt slope = [](Point2d p) { return 0.1 * p.x; };  // 4 m and 5 m at the walls
  const auto told = [&](double top_m) {
    scenes::SceneBuilder town;
    town.add_box({{40, 40}, {50, 50}}, -5.0, top_m);
    const CityModel city = town.city();
    return below_ground(city.buildings().front(), city.points(), slope);
  };
  // From -5 m on, half of the height ends at the lowest ground, 4 m, with 13 m
  for (const double top_m : {13.5, 13.0}) EXPECT_FALSE(told(top_m)) << top_m;
  const auto half = told(12.0);
  ASSERT_TRUE(half);
  EXPECT_THAT(half->detail, HasSubstr("9.000 m of its 17.000 m are below the ground at each of its corners"));
  EXPECT_EQ(half->position->z, 12.0);
  const auto buried = told(3.0);
  ASSERT_TRUE(buried);
  EXPECT_EQ(buried->code, ProblemCode::below_ground);
  EXPECT_THAT(buried->detail, HasSubstr("its highest point is 1.000 m below the ground"));
  EXPECT_EQ(*buried->position, (Point3d{40.0, 40.0, 3.0}));
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

constexpr double height_origin_m = 3.0;
/// Crowns are floats of some hundred metres.
constexpr double float_error_m = 1e-4;

/// Two by two cells of 100 m, turned; the ground rises to the east of the grid.
struct Town {
  Grid grid;
  TreeSettings settings;
  TreesOfCity trees;
  Report report;
  CrownCounts counts;
  std::vector<std::string> notes;

  Town() {
    grid.rotation = GridRotation(Angle::degrees(30.0));
    grid.cell_edge_m = 100.0;
    grid.cells = {0, 0, 2, 2};
    trees.sources = {"a.csv", "b.csv"};
  }
  static double ground_m(Point2d p_grid) { return 10.0 + 0.1 * p_grid.x; }

  void add(Point2d p_grid, float height_m, float crown_m, float trunk_m, std::uint16_t source = 0) {
    trees.trees.push_back({grid.rotation.city_from_grid(p_grid), height_m, crown_m, trunk_m, source, Foliage::evergreen});
  }
  /// A row of cells of 2 m along the x axis of the city.
  void add_canopy(const std::vector<float>& tops_m) {
    CanopyRaster canopy;
    canopy.source = "tops.tif";
    canopy.first = grid.rotation.city_from_grid(Point2d{50.0, 50.0});
    canopy.column_step = {2.0, 0.0};
    canopy.row_step = {0.0, -2.0};
    canopy.columns = tops_m.size();
    canopy.rows = 1;
    canopy.top_m.append(tops_m);
    trees.canopy = std::move(canopy);
  }
  std::vector<CrownsOfCity::OwnedCrown> crowns() {
    const Ground ground({{0, 0, 10}, {200, 0, 30}, {200, 200, 30}, {0, 200, 10}}, grid.rectangle());
    CrownPlacing placing(settings, grid, {1000.0, 2000.0}, report);
    CrownsOfCity placed = placing.run(trees, ground, height_origin_m, {});
    counts = placing.counts();
    notes = placing.notes();
    const auto& all = placed.in_order();
    return {all.begin(), all.end()};
  }
  std::map<int, std::string> problems() const {
    std::map<int, std::string> details;
    for (const Problem& p : report.problems()) details[static_cast<int>(p.code)] += p.source + ": " + p.detail + "\n";
    return details;
  }
};

TEST(CrownsOnGround, TreesAreSpheroidsOnTheGround) {
  Town town;
  town.add({150.0, 50.0}, 8.0F, 6.0F, 2.0F);
  const auto crowns = town.crowns();
  ASSERT_EQ(crowns.size(), 1U);
  EXPECT_EQ(crowns[0].cell, 1U);
  const Crown& c = crowns[0].crown;
  EXPECT_NEAR(c.x_m, 50.0, float_error_m);
  EXPECT_NEAR(c.y_m, 50.0, float_error_m);
  EXPECT_NEAR(c.bottom_m, 25.0 + 2.0 - height_origin_m, float_error_m);
  EXPECT_NEAR(c.top_m, 25.0 + 8.0 - height_origin_m, float_error_m);
  EXPECT_EQ(c.half_width_m, 3.0F);
  EXPECT_EQ(c.shape, CrownShape::spheroid);
  EXPECT_EQ(c.foliage, Foliage::evergreen);
  EXPECT_EQ(c.turn, 0U);
  EXPECT_TRUE(town.report.problems().empty());
  EXPECT_EQ(town.counts, (CrownCounts{1, 0}));
}

TEST(CrownsOnGround, EachTreeCountsOnce) {
  Town town;
  town.add({50.0, 50.0}, 8.0F, 6.0F, 2.0F);
  town.add({50.0, 50.0}, 9.0F, 6.0F, 2.0F);      // another one
  town.add({50.0, 50.0}, 8.0F, 6.0F, 2.0F, 1);   // the first, in another file
  town.add({50.0, 50.0}, 8.0F, 6.0F, 2.0F, 1);   // and once more
  town.add({50.5, 50.0}, 8.0F, 6.0F, 2.0F);      // beside it
  town.add({-0.5, 50.0}, 8.0F, 6.0F, 2.0F);      // outside
  town.add({50.0, 200.5}, 8.0F, 6.0F, 2.0F, 1);  // outside
  EXPECT_EQ(town.crowns().size(), 3U);
  EXPECT_EQ(town.counts, (CrownCounts{3, 0}));
  EXPECT_THAT(town.problems().at(123), HasSubstr("b.csv: 2 of 3 trees have"));
  EXPECT_THAT(town.problems().at(210), HasSubstr("a.csv: 1 of 4 trees stand"));
  EXPECT_THAT(town.problems().at(210), HasSubstr("b.csv: 1 of 3 trees stand"));
  EXPECT_EQ(town.problems().size(), 2U);
}

TEST(CrownsOnGround, DoNotDependOnTheOrderOfTrees) {
  Town there, back;
  for (int n = 0; n < 500; ++n)
    there.add({0.37 * (n * 131 % 500), 0.31 * (n * 57 % 500)}, 3.0F + static_cast<float>(n % 7), 4.0F, 1.0F);
  std::vector<Tree> reversed(there.trees.trees.begin(), there.trees.trees.end());
  std::shuffle(reversed.begin(), reversed.end(), std::mt19937(5));
  back.trees.trees.append(reversed);
  const auto a = there.crowns(), b = back.crowns();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) EXPECT_TRUE(a[n].cell == b[n].cell && a[n].crown == b[n].crown);
}

TEST(CrownsOnGround, CellsAreTurnedPrisms) {
  Town town;
  const float no_data = std::numeric_limits<float>::quiet_NaN();
  town.add_canopy({8.0F, 0.0F, no_data, 4.0F});
  const auto crowns = town.crowns();
  ASSERT_EQ(crowns.size(), 2U);
  const Crown& c = crowns[0].crown;
  EXPECT_EQ(c.shape, CrownShape::prism);
  EXPECT_EQ(c.half_width_m, 1.0F);
  EXPECT_EQ(c.foliage, Foliage::unknown);
  // The city's x axis is turned by 30° to the left in a grid that is turned to the right
  EXPECT_NEAR(c.turn_rad(), Angle::degrees(30.0).radians(), 1e-4);
  EXPECT_NEAR(c.x_m, 50.0, float_error_m);
  EXPECT_NEAR(c.bottom_m, 15.0 + 0.25 * 8.0 - height_origin_m, float_error_m);
  EXPECT_NEAR(c.top_m, 15.0 + 8.0 - height_origin_m, float_error_m);
  EXPECT_EQ(town.counts, (CrownCounts{0, 2}));
  EXPECT_TRUE(town.report.problems().empty());
}

TEST(CrownsOnGround, TrunksAreThoseOfTheirRaster) {
  Town town;
  const float no_data = std::numeric_limits<float>::quiet_NaN();
  town.settings.trunk_ratio = 0.5;
  town.add_canopy({8.0F, 8.0F, 8.0F, 8.0F, 8.0F});
  town.trees.canopy->trunk_m.append(std::vector<float>{1.0F, 0.0F, no_data, 8.0F, -1.0F});
  std::vector<double> trunks_m;
  for (const auto& owned : town.crowns()) trunks_m.push_back(8.0 - (double{owned.crown.top_m} - double{owned.crown.bottom_m}));
  std::sort(trunks_m.begin(), trunks_m.end());
  const std::vector<double> expected{0.0, 1.0, 4.0, 4.0, 4.0};
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_NEAR(trunks_m[n], expected[n], float_error_m);
  EXPECT_THAT(town.problems().at(125), HasSubstr("tops.tif: 2 cells, of which the first: a crown from 8.000 m to 8.000 m"));
  ASSERT_EQ(town.notes.size(), 1U);
  EXPECT_THAT(town.notes[0], HasSubstr("1 cells have crowns, and no height in the raster of trunks"));
}

TEST(CrownsOnGround, HeightsThatNoTreeHasAreLeftOut) {
  Town town;
  town.add_canopy({8.0F, -2.0F, 500.0F});
  EXPECT_EQ(town.crowns().size(), 1U);
  EXPECT_THAT(town.problems().at(124), HasSubstr("2 cells, of which the first: a height of -2.000 m above the ground"));
}

// A crown that ends where it begins, as far as a number of the ground's size can tell
TEST(CrownsOnGround, WhatIsLeftOfAZeroIsNone) {
  Town town;
  town.add_canopy({8.0F, 1e-30F, -1e-9F, 0.009F});
  EXPECT_EQ(town.crowns().size(), 1U);
  EXPECT_TRUE(town.report.problems().empty());
}

TEST(CrownsOnGround, SquaresOfPlantCoversArePrismsAlongTheAxesOfTheCity) {
  Town town;
  town.add({50.0, 50.0}, 6.0F, 2.0F, 0.0F);
  town.trees.trees.back().shape = CrownShape::prism;
  const auto crowns = town.crowns();
  ASSERT_EQ(crowns.size(), 1U);
  const Crown& c = crowns[0].crown;
  EXPECT_EQ(c.shape, CrownShape::prism);
  EXPECT_NEAR(c.turn_rad(), Angle::degrees(30.0).radians(), 1e-4);
  EXPECT_NEAR(c.bottom_m, 15.0 - height_origin_m, float_error_m);
  EXPECT_NEAR(c.top_m, 15.0 + 6.0 - height_origin_m, float_error_m);
  EXPECT_EQ(c.half_width_m, 1.0F);
}

TEST(CrownsOnGround, ElevationsAreLessTheGround) {
  Town town;
  town.settings.heights = CanopyHeights::elevations;
  town.add_canopy({23.0F, 15.2F, 0.0F, -5.0F});  // on ground of 15 m and more
  town.trees.canopy->trunk_m.append(std::vector<float>{17.0F, 0.0F, 0.0F, 0.0F});
  const auto crowns = town.crowns();
  ASSERT_EQ(crowns.size(), 1U);
  EXPECT_NEAR(crowns[0].crown.bottom_m, 17.0 - height_origin_m, float_error_m);
  EXPECT_NEAR(crowns[0].crown.top_m, 23.0 - height_origin_m, float_error_m);
  EXPECT_TRUE(town.report.problems().empty());
}

}  // namespace
}  // namespace farlod::tiles
