// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/preprocess/tiles/bodies.hpp"
#include "tests/preprocess/tiles/borders.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {
namespace {

using test::Face;

/// The upper borders of one building on level ground, those of a role.
struct Borders {
  explicit Borders(const std::vector<Face>& faces, Assign assign = Assign::clip) {
    test::SmallTown town;
    town.add("house", faces);
    const TileSet tiles = town.tiles(assign);
    grounded = test::edges_of(tiles, EdgeRole::grounded);
    overhang = test::edges_of(tiles, EdgeRole::overhang);
    undersides = test::edges_of(tiles, EdgeRole::underside);
  }
  std::vector<Segment3d> grounded, overhang, undersides;
};

/// A closed house from y = 10 to 20, whose upper floor projects to y = 8.
std::vector<Face> house_with_projecting_floor() {
  return {{{10, 10, 0}, {10, 20, 0}, {20, 20, 0}, {20, 10, 0}},
          {{10, 8, 6}, {20, 8, 6}, {20, 20, 6}, {10, 20, 6}},
          {{10, 8, 3}, {10, 10, 3}, {20, 10, 3}, {20, 8, 3}},
          {{10, 10, 0}, {20, 10, 0}, {20, 10, 3}, {10, 10, 3}},
          {{10, 8, 3}, {20, 8, 3}, {20, 8, 6}, {10, 8, 6}},
          {{20, 20, 0}, {10, 20, 0}, {10, 20, 6}, {20, 20, 6}},
          {{20, 10, 0}, {20, 20, 0}, {20, 20, 6}, {20, 8, 6}, {20, 8, 3}, {20, 10, 3}},
          {{10, 20, 0}, {10, 10, 0}, {10, 10, 3}, {10, 8, 3}, {10, 8, 6}, {10, 20, 6}}};
}

/// Four walls from (10, 10) to (20, 20), with a floor.
std::vector<Face> walls_and_floor() {
  return {{{10, 10, 0}, {10, 20, 0}, {20, 20, 0}, {20, 10, 0}},
          {{10, 10, 0}, {20, 10, 0}, {20, 10, 5}, {10, 10, 5}},
          {{20, 20, 0}, {10, 20, 0}, {10, 20, 5}, {20, 20, 5}},
          {{20, 10, 0}, {20, 20, 0}, {20, 20, 5}, {20, 15, 8}, {20, 10, 5}},
          {{10, 20, 0}, {10, 10, 0}, {10, 10, 5}, {10, 15, 8}, {10, 20, 5}}};
}
constexpr float low_m = 4.4F;
/// The same with a gabled roof, a sheet that reaches a metre beyond the walls on all sides. Its ridge runs along y = 15.
std::vector<Face> house_with_eaves() {
  std::vector<Face> faces = walls_and_floor();
  faces.push_back({{9, 9, low_m}, {21, 9, low_m}, {21, 15, 8}, {9, 15, 8}});
  faces.push_back({{21, 21, low_m}, {9, 21, low_m}, {9, 15, 8}, {21, 15, 8}});
  return faces;
}

void add(const std::vector<Face>& more, std::vector<Face>& faces) { faces.insert(faces.end(), more.begin(), more.end()); }

TEST(BorderRoles, AClosedHouseIsGroundedButForItsProjectingFloor) {
  const Borders borders(house_with_projecting_floor());
  EXPECT_EQ(
      borders.grounded,
      test::as_set(
          {{{10, 10, 3}, {20, 10, 3}}, {{10, 20, 6}, {20, 20, 6}}, {{10, 10, 6}, {10, 20, 6}}, {{20, 10, 6}, {20, 20, 6}}}));
  EXPECT_EQ(borders.overhang, test::as_set({{{10, 8, 6}, {20, 8, 6}}, {{10, 8, 6}, {10, 10, 6}}, {{20, 8, 6}, {20, 10, 6}}}));
}

/// The numbers of the grounded surfaces of one building.
std::vector<std::uint32_t> grounded_surfaces(const std::vector<Face>& faces) {
  test::SmallTown town;
  town.add("house", faces);
  std::vector<std::uint32_t> numbers;
  for (const Surface& s : town.tiles().surfaces)
    if (s.building == 1 && s.grounded) numbers.push_back(s.number);
  return numbers;
}

TEST(BorderRoles, OfAHouseThatOverhangsTheWallsBelowGroundedBordersDoNot) {
  // With eaves, all four walls, but neither the floor nor the roofs
  EXPECT_EQ(grounded_surfaces(house_with_eaves()), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  // The wall below the projecting floor, and the back; not the sides, which project
  EXPECT_EQ(grounded_surfaces(house_with_projecting_floor()), (std::vector<std::uint32_t>{3, 5}));
  // A wall that is seen above the next one's border, through a gap of 1 m below it
  std::vector<Face> faces = house_with_eaves();
  faces[1] = {{10, 10, 1}, {20, 10, 1}, {20, 10, 5}, {10, 10, 5}};
  EXPECT_EQ(grounded_surfaces(faces), (std::vector<std::uint32_t>{2, 3, 4}));
}

TEST(BorderRoles, AHouseWithAHoleIsNoSolid) {
  std::vector<Face> faces = house_with_projecting_floor();
  faces.pop_back();  // the west wall
  EXPECT_EQ(Borders(faces).grounded, test::as_set({{{10, 10, 3}, {20, 10, 3}}, {{10, 20, 6}, {20, 20, 6}}})) << "of walls alone";
}

TEST(BorderRoles, ASolidThatFloatsIsNotGrounded) {
  EXPECT_EQ(Borders(test::box(10, 10, 20, 20, 4, 7)).grounded, std::vector<Segment3d>{});
}

TEST(BorderRoles, WhatFloatsAboveASolidIsNotGrounded) {
  // The slab lies over the house, 1 m above its roof: columns break off
  std::vector<Face> faces = test::box(10, 10, 20, 20, 0, 5);
  add(test::box(12, 12, 18, 18, 6, 7), faces);
  const Borders borders(faces);
  EXPECT_EQ(borders.grounded.size(), 4U) << "the roof's";
  EXPECT_EQ(
      borders.overhang,
      test::as_set(
          {{{12, 12, 7}, {18, 12, 7}}, {{12, 12, 7}, {12, 18, 7}}, {{18, 12, 7}, {18, 18, 7}}, {{12, 18, 7}, {18, 18, 7}}}));
}

TEST(BorderRoles, AChimneyThatReachesIntoTheHouseIsGrounded) {
  std::vector<Face> faces = house_with_projecting_floor();
  add(test::box(14, 14, 15, 15, 4, 8), faces);  // its foot is inside of the solid
  const Borders borders(faces);
  EXPECT_EQ(borders.grounded.size(), 4U + 4U);
  EXPECT_EQ(borders.overhang.size(), 3U);
}

/// A house with a hollow that is open to the south and to the east.
std::vector<Face> house_open_at_a_corner() {
  return {{{10, 10, 0}, {10, 20, 0}, {20, 20, 0}, {20, 10, 0}},
          {{10, 10, 6}, {20, 10, 6}, {20, 20, 6}, {10, 20, 6}},
          {{10, 10, 0}, {20, 10, 0}, {20, 10, 1}, {19.5, 10, 1}, {19.5, 10, 3}, {20, 10, 3}, {20, 10, 6}, {10, 10, 6}},
          {{20, 10, 0}, {20, 20, 0}, {20, 20, 6}, {20, 10, 6}, {20, 10, 3}, {20, 10.5, 3}, {20, 10.5, 1}, {20, 10, 1}},
          {{19.5, 10, 1}, {20, 10, 1}, {20, 10.5, 1}, {19.5, 10.5, 1}},
          {{19.5, 10.5, 3}, {20, 10.5, 3}, {20, 10, 3}, {19.5, 10, 3}},
          {{19.5, 10, 1}, {19.5, 10.5, 1}, {19.5, 10.5, 3}, {19.5, 10, 3}},
          {{19.5, 10.5, 1}, {20, 10.5, 1}, {20, 10.5, 3}, {19.5, 10.5, 3}},
          {{20, 20, 0}, {10, 20, 0}, {10, 20, 6}, {20, 20, 6}},
          {{10, 20, 0}, {10, 10, 0}, {10, 10, 6}, {10, 20, 6}}};
}

/// A gable to the south, from 6 m up to 8 m at x = 15, over a window set back by 25 cm.
std::vector<Face> gable_over_a_window() {
  std::vector<Face> faces = test::house_with_recess(10.25, 13.5);
  faces[1] = {{10, 10, 3}, {13.5, 10, 6.5}, {15, 10, 8}, {15, 20, 8}, {10, 20, 3}};
  faces[2] = {{10, 10, 0}, {13.5, 10, 0}, {13.5, 10, 1}, {13.5, 10, 3}, {13.5, 10, 6.5}, {10, 10, 3}};
  faces[3] = {{17, 10, 0}, {20, 10, 0}, {20, 10, 3}, {17, 10, 6}, {17, 10, 3}, {17, 10, 1}};
  faces[5] = {{13.5, 10, 3}, {17, 10, 3}, {17, 10, 6}, {15, 10, 8}, {13.5, 10, 6.5}};
  faces[10] = {{20, 10, 0}, {20, 20, 0}, {20, 20, 3}, {20, 10, 3}};
  faces[11] = {{10, 20, 0}, {10, 10, 0}, {10, 10, 3}, {10, 20, 3}};
  faces[13] = {{20, 20, 0}, {10, 20, 0}, {10, 20, 3}, {15, 20, 8}, {20, 20, 3}};
  faces.push_back({{15, 10, 8}, {17, 10, 6}, {20, 10, 3}, {20, 20, 3}, {15, 20, 8}});
  return faces;
}

/// A closed house from (10, 10) to (20, 30) whose roof rises from 0 m in the south by 1 in 2.
std::vector<Face> house_with_slope() {
  return {{{10, 10, 0}, {20, 10, 0}, {20, 30, 10}, {10, 30, 10}},
          {{10, 10, 0}, {10, 30, 0}, {20, 30, 0}, {20, 10, 0}},
          {{20, 10, 0}, {20, 30, 0}, {20, 30, 10}},
          {{10, 30, 0}, {10, 10, 0}, {10, 30, 10}},
          {{20, 30, 0}, {10, 30, 0}, {10, 30, 10}, {20, 30, 10}}};
}

/// Of the grounded borders, those above all walls: the ridge of a house with eaves.
std::vector<Segment3d> grounded_ridge(const std::vector<Face>& faces) {
  std::vector<Segment3d> ridge;
  for (const Segment3d& s : Borders(faces).grounded)
    if (std::min(s.a.z, s.b.z) >= 8.0) ridge.push_back(s);
  return ridge;
}

TEST(BorderRoles, AHouseWithEavesIsGroundedWithinItsWalls) {
  EXPECT_EQ(grounded_ridge(house_with_eaves()), (std::vector<Segment3d>{{{10, 15, 8}, {20, 15, 8}}}));
  EXPECT_EQ(Borders(house_with_eaves()).overhang, test::as_set({{{9, 15, 8}, {10, 15, 8}},
                                                                {{20, 15, 8}, {21, 15, 8}},
                                                                {{9, 9, low_m}, {21, 9, low_m}},
                                                                {{9, 21, low_m}, {21, 21, low_m}},
                                                                {{9, 9, low_m}, {9, 15, 8}},
                                                                {{9, 15, 8}, {9, 21, low_m}},
                                                                {{21, 9, low_m}, {21, 15, 8}},
                                                                {{21, 15, 8}, {21, 21, low_m}}}));
}

TEST(BorderRoles, AHipThatLeavesTheWallsBesideTheirCornerIsGroundedUpToTheWall) {
  // The eaves reach 2 cm farther in the west: the hips there meet the line of a wall 1.7 cm outside of the other one
  std::vector<Face> faces = walls_and_floor();
  faces[3] = {{20, 10, 0}, {20, 20, 0}, {20, 20, 5}, {20, 10, 5}};
  faces[4] = {{10, 20, 0}, {10, 10, 0}, {10, 10, 5}, {10, 20, 5}};
  constexpr Point3d top{15, 15, 8};
  const Face eaves{{8.98, 9, low_m}, {21, 9, low_m}, {21, 21, low_m}, {8.98, 21, low_m}};
  for (std::size_t n = 0; n < 4; ++n) faces.push_back({eaves[n], eaves[(n + 1) % 4], top});
  const Borders borders(faces);
  std::size_t hips = 0;
  for (const auto& [a, b] : borders.grounded) {
    for (const Point3d& p : {a, b}) EXPECT_GE(std::min({p.x - 10, 20 - p.x, p.y - 10, 20 - p.y}), -1e-4) << p.x << ' ' << p.y;
    hips += std::max(a.z, b.z) > 5.5 ? 1 : 0;
  }
  EXPECT_EQ(hips, 4U);
}

TEST(BorderRoles, ARidgeIsGroundedUpToTheWallHoweverLittleItReachesBeyond) {
  std::vector<Face> faces = walls_and_floor();
  faces.push_back({{9.985, 9, low_m}, {20.015, 9, low_m}, {20.015, 15, 8}, {9.985, 15, 8}});
  faces.push_back({{20.015, 21, low_m}, {9.985, 21, low_m}, {9.985, 15, 8}, {20.015, 15, 8}});
  EXPECT_EQ(grounded_ridge(faces), (std::vector<Segment3d>{{{10, 15, 8}, {20, 15, 8}}}));
}

TEST(BorderRoles, WithinWallsNothingMayFloat) {
  // A wall is missing: the others form no ring
  std::vector<Face> open = house_with_eaves();
  open.erase(open.begin() + 1);
  EXPECT_TRUE(grounded_ridge(open).empty());
  open.erase(open.begin());  // nor without the floor, whose border would be loose
  EXPECT_TRUE(grounded_ridge(open).empty());
  // The roof lies 10 cm above the walls
  std::vector<Face> lifted = walls_and_floor();
  lifted.push_back({{9, 9, 4.5}, {21, 9, 4.5}, {21, 15, 8.1}, {9, 15, 8.1}});
  lifted.push_back({{21, 21, 4.5}, {9, 21, 4.5}, {9, 15, 8.1}, {21, 15, 8.1}});
  EXPECT_TRUE(grounded_ridge(lifted).empty());
  // A hole in the roof, between the walls
  std::vector<Face> pierced = walls_and_floor();
  pierced.push_back(
      {{9, 9, low_m}, {21, 9, low_m}, {21, 15, 8}, {16, 15, 8}, {16, 12, 6.2}, {14, 12, 6.2}, {14, 15, 8}, {9, 15, 8}});
  pierced.push_back({{21, 21, low_m}, {9, 21, low_m}, {9, 15, 8}, {14, 15, 8}, {16, 15, 8}, {21, 15, 8}});
  EXPECT_TRUE(grounded_ridge(pierced).empty());
  // A slab between the walls
  std::vector<Face> filled = house_with_eaves();
  add(test::box(12, 12, 18, 13, 2, 3), filled);
  EXPECT_TRUE(grounded_ridge(filled).empty());
}

TEST(BorderRoles, WhatLiesInsideOfASolidIsNoHorizon) {
  // Above the recess, the solid does not reach the ground
  const Borders borders(test::house_with_recess(11.5));
  EXPECT_EQ(borders.overhang, (std::vector<Segment3d>{{{14, 10, 6}, {17, 10, 6}}}));
  for (const Segment3d& s : borders.grounded) EXPECT_NE(s.a.z, 3.0) << "of the ceiling of the recess";
}

TEST(BorderRoles, AWindowSetBackLeavesAHouseGrounded) {
  const Borders borders(test::house_with_recess(10.25));
  EXPECT_EQ(borders.overhang, std::vector<Segment3d>{});
  EXPECT_EQ(borders.undersides, std::vector<Segment3d>{});
  for (const Segment3d& s : borders.grounded) EXPECT_EQ(std::min(s.a.z, s.b.z), 6.0) << "neither the sill nor the ceiling";
  EXPECT_TRUE(test::covers(borders.grounded, {{14, 10, 6}, {17, 10, 6}}));
}

TEST(BorderRoles, OfABuildingThatIsNotCutNoBorderLiesOverARecess) {
  const Borders borders(test::house_with_recess(10.25), Assign::whole);
  EXPECT_EQ(borders.overhang, (std::vector<Segment3d>{{{14, 10, 6}, {17, 10, 6}}}));
}

TEST(BorderRoles, ARecessIsOpenOnOneSideAlone) {
  // Up to the corner of the house, through it, and up to its roof: what is seen above may float
  EXPECT_TRUE(test::covers(Borders(house_open_at_a_corner()).overhang, {{19.5, 10, 6}, {20, 10, 6}}));
  EXPECT_TRUE(test::covers(Borders(test::house_with_recess(20)).overhang, {{14, 10, 6}, {17, 10, 6}}));
  EXPECT_TRUE(test::covers(Borders(test::house_with_recess(10.25, 14, 5.99)).overhang, {{14, 10, 6}, {17, 10, 6}}));
}

TEST(BorderRoles, ARecessIsNoLargerThanReceiversLook) {
  EXPECT_TRUE(Borders(test::house_with_recess(10.25, 13.1)).overhang.empty());
  EXPECT_EQ(Borders(test::house_with_recess(10.25, 12.9)).overhang.size(), 1U) << "4.1 m wide";
}

TEST(BorderRoles, ARidgeOverAWindowIsGroundedToo) {
  // Two halves of a gable over one window: each border ends above its middle, and the ridge begins there
  const Borders borders(gable_over_a_window());
  EXPECT_EQ(borders.overhang, std::vector<Segment3d>{});
  EXPECT_EQ(borders.undersides, std::vector<Segment3d>{});
}

TEST(BorderRoles, ABorderIsHiddenAsFarAsItLiesBelowARoof) {
  // A dormer of the house on its slope, which rises by 1 in 2: its eaves at 4 m end in the roof at y = 18
  std::vector<Face> faces = house_with_slope();
  add(test::box(13, 13.5, 15, 22, 1.5, 4), faces);
  const Borders borders(faces);
  EXPECT_TRUE(test::covers(borders.grounded, {{13, 13.5, 4}, {13, 17.95, 4}}));
  for (const Segment3d& s : borders.grounded)
    if (s.a.z == 4.0 && s.b.z == 4.0) {
      EXPECT_LT(std::max(s.a.y, s.b.y), 18.05);
    }
  EXPECT_EQ(borders.undersides, std::vector<Segment3d>{}) << "the floor of the dormer lies in the house";
}

TEST(BorderRoles, WhatLeansOutAtACornerShowsSkyBelow) {
  // A tower on a house: its top reaches 3 mm farther east than its foot, which no tolerance of walls may hide
  std::vector<Face> faces = test::box(10, 10, 20, 20, 0, 5);
  std::vector<Face> tower = test::box(12, 12, 18, 18, 5, 9);
  for (Face& face : tower)
    for (Point3d& p : face)
      if (p.x == 18 && p.z == 9) p.x = 18.003;
  add(tower, faces);
  add(test::box(2, 2, 3, 3, 6, 7), faces);  // what overhangs
  const Borders borders(faces);
  const std::vector<Segment3d> corners{{{18, 12, 9}, {18.003, 12, 9}}, {{18, 18, 9}, {18.003, 18, 9}}};
  for (const Segment3d& corner : corners) {
    EXPECT_TRUE(test::covers(borders.overhang, corner));
    EXPECT_TRUE(test::covers(borders.undersides, corner));
    EXPECT_FALSE(test::covers(borders.grounded, corner));
  }
}

TEST(BorderRoles, ACornerThatLeansInIsALowerBorder) {
  // A tower on a house: its top reaches .5 mm farther north and east than its foot. Beside the walls' ends no column of the
  // solid is below their upper borders, for more than a corner's width
  std::vector<Face> faces = test::box(10, 10, 20, 20, 0, 5);
  std::vector<Face> tower = test::box(12, 12, 18, 18, 5, 9);
  for (Face& face : tower)
    for (Point3d& p : face)
      if (p.z == 9) p = {p.x == 18 ? 18.0005 : p.x, p.y == 18 ? 18.0005 : p.y, p.z};
  add(tower, faces);
  add(test::box(2, 2, 3, 3, 6, 7), faces);  // what overhangs
  const Borders borders(faces);
  EXPECT_TRUE(test::covers(borders.overhang, {{18.0005, 18.0005, 9}, {17.9, 18.0005, 9}}));
  EXPECT_TRUE(test::has_near(borders.undersides, {{18, 18, 9}, {18.0005, 18.0005, 9}}));
}

TEST(BorderRoles, ACornerInPiecesIsALowerBorderInPieces) {
  // The same in two storeys: the upper one leans by .5 mm, and so does the lower one
  std::vector<Face> faces = test::box(10, 10, 20, 20, 0, 5);
  const auto leaning = [](double low_m, double high_m, double out_m) {
    std::vector<Face> storey = test::box(12, 12, 18 + out_m, 18 + out_m, low_m, high_m);
    for (Face& face : storey)
      for (Point3d& p : face)
        if (p.z == high_m) p = {p.x > 12 ? p.x + .0005 : p.x, p.y > 12 ? p.y + .0005 : p.y, p.z};
    return storey;
  };
  std::vector<Face> lower = leaning(5, 7, 0), upper = leaning(7, 9, .0005);
  lower.erase(lower.begin());  // its roof
  upper.pop_back();            // and the other's floor
  add(lower, faces);
  add(upper, faces);
  add(test::box(2, 2, 3, 3, 6, 7), faces);  // what overhangs
  const Borders borders(faces);
  EXPECT_TRUE(test::has_near(borders.undersides, {{18.0005, 18.0005, 9}, {18.001, 18.001, 9}}));
  EXPECT_TRUE(test::has_near(borders.undersides, {{18, 18, 7}, {18.0005, 18.0005, 7}}));
}

TEST(BorderRoles, WhatIsRightBelowAGroundedBorderIsNoHorizon) {
  // A balcony at the south wall: its inner border lies on the wall, below the wall's upper border
  std::vector<Face> faces = test::box(10, 10, 20, 20, 0, 9);
  add(test::box(12, 8, 18, 10, 3, 4), faces);
  const Borders borders(faces);
  EXPECT_EQ(borders.grounded.size(), 4U);
  EXPECT_EQ(borders.overhang, test::as_set({{{12, 8, 4}, {18, 8, 4}}, {{12, 8, 4}, {12, 10, 4}}, {{18, 8, 4}, {18, 10, 4}}}));
}

}  // namespace
}  // namespace farlod::tiles
