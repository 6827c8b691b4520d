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
  explicit Borders(const std::vector<Face>& faces) {
    test::SmallTown town;
    town.add("house", faces);
    const TileSet tiles = town.tiles();
    grounded = test::edges_of(tiles, EdgeRole::grounded);
    overhang = test::edges_of(tiles, EdgeRole::overhang);
  }
  std::vector<Segment3d> grounded, overhang;
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
  // A recess of the south wall, from x = 13 to 17 and from 1 to 3 m: above it, the solid does not reach the ground
  const Borders borders({{{10, 10, 0}, {10, 20, 0}, {20, 20, 0}, {20, 10, 0}, {17, 10, 0}, {13, 10, 0}},
                         {{10, 10, 6}, {13, 10, 6}, {17, 10, 6}, {20, 10, 6}, {20, 20, 6}, {10, 20, 6}},
                         {{10, 10, 0}, {13, 10, 0}, {13, 10, 1}, {13, 10, 3}, {13, 10, 6}, {10, 10, 6}},
                         {{17, 10, 0}, {20, 10, 0}, {20, 10, 6}, {17, 10, 6}, {17, 10, 3}, {17, 10, 1}},
                         {{13, 10, 0}, {17, 10, 0}, {17, 10, 1}, {13, 10, 1}},
                         {{13, 10, 3}, {17, 10, 3}, {17, 10, 6}, {13, 10, 6}},
                         {{13, 11, 1}, {17, 11, 1}, {17, 11, 3}, {13, 11, 3}},
                         {{13, 10, 1}, {13, 11, 1}, {13, 11, 3}, {13, 10, 3}},
                         {{17, 11, 1}, {17, 10, 1}, {17, 10, 3}, {17, 11, 3}},
                         {{13, 10, 1}, {17, 10, 1}, {17, 11, 1}, {13, 11, 1}},
                         {{13, 11, 3}, {17, 11, 3}, {17, 10, 3}, {13, 10, 3}},
                         {{20, 10, 0}, {20, 20, 0}, {20, 20, 6}, {20, 10, 6}},
                         {{20, 20, 0}, {10, 20, 0}, {10, 20, 6}, {20, 20, 6}},
                         {{10, 20, 0}, {10, 10, 0}, {10, 10, 6}, {10, 20, 6}}});
  EXPECT_EQ(borders.overhang, (std::vector<Segment3d>{{{13, 10, 6}, {17, 10, 6}}}));
  for (const Segment3d& s : borders.grounded) EXPECT_NE(s.a.z, 3.0) << "of the ceiling of the recess";
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
