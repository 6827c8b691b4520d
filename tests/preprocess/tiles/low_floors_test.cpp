// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "tests/preprocess/tiles/borders.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/foundations.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles {
namespace {

using test::Face;

void add_to(std::vector<Face>& faces, const std::vector<Face>& more) { faces.insert(faces.end(), more.begin(), more.end()); }

/// A house from (10, 10) to (20, 20) that stands on the ground, 10 m high, and what else belongs to it.
std::vector<Face> house_and(const std::vector<Face>& part) {
  auto faces = test::box(10, 10, 20, 20, 0, 10);
  add_to(faces, part);
  return faces;
}

/// Its second part: to the east, 12 m by 10 m, and up to a height of 12 m.
std::vector<Face> part_from(double floor_m) { return test::box(20, 10, 32, 20, floor_m, 12); }

/// One whose four walls lean inwards by 1 m.
std::vector<Face> narrowing_part() {
  const Face foot{{20, 10, 1.5}, {32, 10, 1.5}, {32, 20, 1.5}, {20, 20, 1.5}},
      top{{21, 11, 9}, {31, 11, 9}, {31, 19, 9}, {21, 19, 9}};
  std::vector<Face> faces{top, {foot[3], foot[2], foot[1], foot[0]}};
  for (std::size_t n = 0; n < foot.size(); ++n) {
    const std::size_t next = (n + 1) % foot.size();
    faces.push_back({foot[n], foot[next], top[next], top[n]});
  }
  return faces;
}

/// Two wings, 12 m deep, and a bridge of rooms between them: below it is a passage of this width and height.
std::vector<Face> house_with_passage(double width_m, double height_m) {
  auto faces = test::box(5, 10, 10, 22, 0, 10);
  add_to(faces, test::box(10 + width_m, 10, 15 + width_m, 22, 0, 10));
  add_to(faces, test::box(10, 10, 10 + width_m, 22, height_m, 10));
  return faces;
}

/// Ground that falls to the north: by 1 m in so many. It is at 0 m where houses begin, at y = 10.
TerrainRaster falling_terrain(double run_m) {
  TerrainRaster terrain{{-200, -200}, {200, 200}, 3, 3, {}};
  for (const double y : {-200.0, 0.0, 200.0})
    for (int column = 0; column < 3; ++column) terrain.height_m.emplace_back(static_cast<float>((10.0 - y) / run_m));
  return terrain;
}

struct Tiled {
  TileSet tiles;
  std::vector<Problem> problems;
  [[nodiscard]] std::size_t lower_borders() const { return test::edges_of(tiles, EdgeRole::underside).size(); }
};

Tiled tiled(const std::vector<Face>& building, const TerrainRaster& terrain = test::level_terrain(),
            Assign assign = Assign::clip) {
  test::SmallTown town;
  town.add("house", building);
  Report report;
  const Grid grid = scenes::grid_covering(town.city(), {}, 50, 3);
  TileSet tiles = cut_into_tiles({town.city(), {}}, grid, assign, terrain, report);
  Tiled result{std::move(tiles), {}};
  // Not of what else stands on a slope
  std::ranges::copy_if(report.problems(), std::back_inserter(result.problems),
                       [](const Problem& p) { return p.place == "house"; });
  return result;
}

double area_of_foundations(const TileSet& tiles) {
  double area_m2 = 0.0;
  for (const Surface& s : tiles.surfaces) area_m2 += s.kind == SurfaceKind::foundation ? s.area_m2 : 0.0;
  return area_m2;
}

TEST(LowFloors, AreClosedWhereNobodyCanStandBelowThem) {
  for (const Assign assign : {Assign::clip, Assign::whole}) {
    const Tiled town = tiled(house_and(part_from(1.5)), test::level_terrain(), assign);
    EXPECT_EQ(town.tiles.foundation_count, 1U);
    EXPECT_EQ(town.lower_borders(), 0U) << "nothing is seen below it";
    EXPECT_TRUE(test::edges_of(town.tiles, EdgeRole::overhang).empty());
    EXPECT_TRUE(test::is_grounded(town.tiles, 1));
    // Four walls from the floor at 1.5 m to .5 m below the ground, and the floor again as their lid: below it is inside
    constexpr double rounding_m2 = 1e-3;
    EXPECT_NEAR(area_of_foundations(town.tiles), 2 * (12 + 10) * 2.0 + 12 * 10, rounding_m2);
    EXPECT_TRUE(town.problems.empty()) << "foundations are only counted";
  }
}

TEST(LowFloors, CountOnceWithTheFoundationOfTheirBuilding) {
  auto building = test::box(10, 10, 20, 20, 0.4, 10);
  add_to(building, part_from(1.5));
  add_to(building, test::box(10, 20, 20, 32, 2.3, 12));
  const Tiled town = tiled(building);
  EXPECT_EQ(town.tiles.foundation_count, 1U);
  EXPECT_EQ(town.lower_borders(), 0U);
  EXPECT_TRUE(test::is_grounded(town.tiles, 1));
}

TEST(LowFloors, CarryWhatStandsOnThem) {
  // A balcony, so that the house overhangs somewhere: a sheet, of which only the walls tell; and a body, before walls that lean
  auto upright = house_and(part_from(1.5)), leaning = house_and(narrowing_part());
  upright.push_back({{32, 12, 6}, {34, 12, 6}, {34, 18, 6}, {32, 18, 6}});
  add_to(leaning, test::box(6, 12, 10, 18, 6.0, 6.2));
  for (const auto& building : {upright, leaning}) {
    const Tiled town = tiled(building);
    EXPECT_GT(town.lower_borders(), 0U);
    for (const Segment3d& e : test::edges_of(town.tiles, EdgeRole::overhang)) EXPECT_LT(std::max(e.a.z, e.b.z), 7.0);
    for (const Segment3d& e : test::edges_of(town.tiles, EdgeRole::underside)) EXPECT_GT(std::min(e.a.z, e.b.z), 5.0);
  }
}

// Property (1)
TEST(LowFloors, StayOpenWhereOneCanWalkBelowThem) {
  EXPECT_EQ(tiled(house_and(part_from(2.4))).tiles.foundation_count, 1U);
  for (const double floor_m : {2.6, 3.0, 4.0}) {
    const Tiled town = tiled(house_and(part_from(floor_m)));
    EXPECT_EQ(town.tiles.foundation_count, 0U) << floor_m;
    EXPECT_GT(town.lower_borders(), 0U) << floor_m;
    EXPECT_TRUE(town.problems.empty()) << floor_m;
  }
}

TEST(LowFloors, DoNotClosePassages) {
  for (const double width_m : {3.0, 5.0, 8.0}) {
    const Tiled town = tiled(house_with_passage(width_m, 3.0));
    EXPECT_EQ(town.tiles.foundation_count, 0U) << width_m;
    EXPECT_GT(town.lower_borders(), 0U) << width_m;
  }
}

TEST(LowFloors, AreToldWhereOneCanStandBelowAPartOfThem) {
  // From 2.4 m in the south to 2.9 m in the north
  const Tiled town = tiled(house_with_passage(5.0, 2.4), falling_terrain(24.0));
  EXPECT_GT(town.lower_borders(), 0U);
  ASSERT_EQ(town.problems.size(), 1U);
  EXPECT_EQ(town.problems[0].code, ProblemCode::floor_in_the_air);
  EXPECT_EQ(town.problems[0].place, "house");
  EXPECT_THAT(town.problems[0].detail, testing::HasSubstr("2.400 m to 2.900 m above the ground: left open"));
  ASSERT_TRUE(town.problems[0].position.has_value());
  EXPECT_NEAR(town.problems[0].position->z, 2.4, 1e-9);
}

TEST(LowFloors, AreToldWhereAStoreyFitsBelowAPartOfThem) {
  // From 1.4 m to 3.07 m, with a mean of 2.23 m
  const Tiled town = tiled(house_and(part_from(1.4)), falling_terrain(6.0));
  EXPECT_GT(town.lower_borders(), 0U);
  ASSERT_EQ(town.problems.size(), 1U);
  EXPECT_THAT(town.problems[0].detail, testing::HasSubstr("left open"));
}

// Property (2): 2.2 m above the ground, and downhill more
TEST(LowFloors, AreNoBalconies) {
  for (const double top_m : {2.4, 3.4}) {  // without a parapet, and with one
    auto house = test::box(10, 10, 20, 20, -5, 10);
    add_to(house, test::box(20, 10, 26, 20, 2.2, top_m));
    for (const TerrainRaster& terrain : {test::level_terrain(), falling_terrain(50.0)}) {
      const Tiled town = tiled(house, terrain);
      EXPECT_EQ(town.tiles.foundation_count, 0U) << top_m;
      EXPECT_GT(town.lower_borders(), 0U) << top_m;
      EXPECT_TRUE(town.problems.empty()) << top_m;
    }
  }
}

// Property (3)
TEST(LowFloors, AreNeitherBaysNorNiches) {
  const auto bay = test::box(20, 13, 21, 16, 1.5, 6);
  EXPECT_GT(tiled(house_and(bay)).lower_borders(), 0U);
  EXPECT_EQ(tiled(house_and(bay)).tiles.foundation_count, 0U);
  const Tiled niche = tiled(house_with_passage(1.5, 2.2));
  EXPECT_GT(niche.lower_borders(), 0U);
  EXPECT_EQ(niche.tiles.foundation_count, 0U);
}

// Property (4): 5 m wide, from a sill at 1 m to 2.4 m, and right through the house
TEST(LowFloors, AreNotAboveWindows) {
  const Tiled town = tiled(test::house_with_recess(20, 12, 2.4));
  EXPECT_EQ(town.tiles.foundation_count, 0U);
  EXPECT_EQ(area_of_foundations(town.tiles), 0.0);
  EXPECT_TRUE(town.problems.empty());
}

}  // namespace
}  // namespace farlod::tiles
