// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/contacts.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tests/preprocess/tiles/borders.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {
namespace {

using test::area_m2;
using testing::IsEmpty;

/// A lower border 10 m long, 5 m up, along the x axis.
const HorizonEdge border{{2, 4, 5}, {12, 4, 5}, {3, AdjacentSlopes::straight_up}, EdgeRole::underside};

std::vector<HorizonEdge> open_parts(const std::vector<std::vector<Point3f>>& polygons) {
  Tile tile;
  for (const auto& polygon : polygons) tile.add_polygon(polygon, 0);
  std::vector<ClosingTriangle> closing;
  return without_contacts(border, tile, closing);
}

std::vector<Point3f> upright(float y, float x0, float x1, float low_m, float high_m) {
  return {{x0, y, low_m}, {x1, y, low_m}, {x1, y, high_m}, {x0, y, high_m}};
}
std::vector<Point3f> level(float x0, float y0, float x1, float y1, float z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

void expect_whole(const std::vector<HorizonEdge>& open) {
  ASSERT_EQ(open.size(), 1U);
  EXPECT_EQ(open[0], border);
}

TEST(Contacts, WithoutAnyTheBorderStaysWhole) {
  expect_whole(open_parts({}));
  expect_whole(open_parts({level(0, 0, 20, 20, 0)}));
}

TEST(Contacts, ItsOwnFacetsCloseNothing) { expect_whole(open_parts({upright(4, 2, 12, 5, 9), level(2, 4, 12, 9, 5)})); }

TEST(Contacts, FloatingDuplicatesCloseNothing) {
  const auto wall = upright(4, 2, 12, 5, 9), soffit = level(2, 4, 12, 9, 5);
  expect_whole(open_parts({wall, soffit, wall, soffit}));
}

TEST(Contacts, AWallBelowOrAcrossCloses) {
  EXPECT_THAT(open_parts({upright(4, 2, 12, 0, 5)}), IsEmpty());
  EXPECT_THAT(open_parts({upright(4, 0, 20, 0, 30)}), IsEmpty());
}

TEST(Contacts, AWallThatLeansByLittleCloses) {
  // Its corners are rounded, and its top stands a centimetre beside the border
  EXPECT_THAT(open_parts({{{2, 4.01F, 5}, {12, 4.01F, 5}, {12, 4.03F, 1}, {2, 4.03F, 1}}}), IsEmpty());
  EXPECT_THAT(open_parts({{{2, 4, 5}, {12, 4, 5}, {12, 4.001F, 4.9F}, {2, 4.001F, 4.9F}}}), IsEmpty());
}

TEST(Contacts, AWallThatLeansByMoreDoesNotEvenWhereItsSectionIsShort) {
  // The triangle below the border ends 4 m to the west of it and 4 m lower: across the border it is only centimetres high
  expect_whole(open_parts({{{2, 4, 5}, {12, 4, 5}, {-30, 4.08F, 1}}}));
}

TEST(Contacts, ARoofThatGoesOnOnBothSidesCloses) {
  EXPECT_THAT(open_parts({level(0, 0, 20, 20, 5)}), IsEmpty());
  // One side may be the border's own facet
  EXPECT_THAT(open_parts({level(2, 4, 12, 9, 5), level(0, 0, 20, 4, 5)}), IsEmpty());
}

TEST(Contacts, ARoofOnOneSideAloneDoesNot) { expect_whole(open_parts({level(0, 4, 20, 9, 5)})); }

TEST(Contacts, ASlopeThatFallsToOneSideAndRisesToTheOther) {
  // It cuts the border's line: below it, the slope goes on
  EXPECT_THAT(open_parts({{{0, 0, 3}, {20, 0, 3}, {20, 8, 7}, {0, 8, 7}}}), IsEmpty());
}

TEST(Contacts, AreNearerThanTheirDistance) {
  const auto near_m = static_cast<float>(0.7 * contact_m), far_m = static_cast<float>(1.5 * contact_m);
  EXPECT_THAT(open_parts({level(0, 0, 20, 20, 5 - near_m)}), IsEmpty());
  EXPECT_THAT(open_parts({upright(4 + near_m, 2, 12, 0, 5)}), IsEmpty());
  expect_whole(open_parts({level(0, 0, 20, 20, 5 - far_m)}));
  expect_whole(open_parts({upright(4 + far_m, 2, 12, 0, 5)}));
}

TEST(Contacts, WhatTouchesAPartClosesThatPart) {
  const auto open = open_parts({upright(4, 5, 8, 0, 5)});
  ASSERT_EQ(open.size(), 2U);
  const std::array<std::pair<float, float>, 2> expected{{{2, 5}, {8, 12}}};
  for (std::size_t n = 0; n < 2; ++n) {
    // At a corner both sides of a triangle are that far away: at a right angle and more, √2 times
    EXPECT_NEAR(open[n].a.x, expected[n].first, 1.5 * contact_m);
    EXPECT_NEAR(open[n].b.x, expected[n].second, 1.5 * contact_m);
    for (const Point3f& p : {open[n].a, open[n].b}) EXPECT_EQ((Point3f{0, p.y, p.z}), (Point3f{0, 4, 5}));
    EXPECT_EQ(open[n].adjacent, border.adjacent);
    EXPECT_EQ(open[n].role, EdgeRole::underside);
  }
}

TEST(Contacts, TwoThatTogetherCoverItCloseItWhole) {
  EXPECT_THAT(open_parts({upright(4, 0, 7, 0, 5), upright(4, 7, 15, 0, 9)}), IsEmpty());
}

TEST(Contacts, AWallAcrossTheBorderTouchesAPlaceOnly) {
  double length_m = 0.0;
  for (const HorizonEdge& e : open_parts({{{7, 0, 0}, {7, 9, 0}, {7, 9, 9}, {7, 0, 9}}})) length_m += e.b.x - e.a.x;
  EXPECT_NEAR(length_m, 10.0, 3.0 * contact_m);
}

// The whole tile stage

TEST(Contacts, BelowABodyOnAnotherBuildingsRoofNoSkyIsSeen) {
  test::SmallTown town;
  town.add("house", test::box(2, 2, 30, 30, 0, 9));
  town.add("penthouse", test::box(5, 5, 15, 15, 9, 12));
  const TileSet tiles = town.tiles();
  EXPECT_THAT(test::edges_of(tiles, EdgeRole::underside), IsEmpty());
  EXPECT_THAT(test::edges_of(tiles, EdgeRole::overhang), IsEmpty());
  EXPECT_FALSE(test::is_grounded(tiles, 2)) << "what rests on walls all around may be overhead";
  for (const Surface& s : tiles.surfaces)
    if (s.building == 2) EXPECT_EQ(s.grounded, s.kind == SurfaceKind::wall) << s.number << ": its walls hide nothing more";
}

TEST(Contacts, ABodyThatReachesOverTheRoofsEdgeIsNot) {
  test::SmallTown town;
  town.add("house", test::box(2, 2, 30, 30, 0, 9));
  town.add("penthouse", test::box(5, 5, 35, 15, 9, 12));
  const TileSet tiles = town.tiles();
  EXPECT_FALSE(test::is_grounded(tiles, 2));
  // What lies beyond the roof is open: 5 m on both sides, and the end
  double open_m = 0.0;
  for (const Segment3d& s : test::edges_of(tiles, EdgeRole::underside)) open_m += norm(s.b - s.a);
  EXPECT_NEAR(open_m, 5.0 + 10.0 + 5.0, 4.0 * contact_m);
}

TEST(Contacts, ABridgeBetweenTwoHousesIsOpenAlongItsSidesAlone) {
  test::SmallTown town;
  town.add("west", test::box(2, 2, 12, 30, 0, 15));
  town.add("east", test::box(30, 2, 40, 30, 0, 15));
  town.add("bridge", test::box(12, 10, 30, 14, 6, 9));
  const TileSet tiles = town.tiles();
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::underside), test::as_set({{{12, 10, 6}, {30, 10, 6}}, {{12, 14, 6}, {30, 14, 6}}}));
}

TEST(Contacts, TwoFloatingDuplicatesStayOpen) {
  test::SmallTown town;
  town.add("bridge", test::box(10, 10, 30, 14, 6, 9));
  town.add("again", test::box(10, 10, 30, 14, 6, 9));
  const TileSet tiles = town.tiles();
  EXPECT_FALSE(test::is_grounded(tiles, 1));
  EXPECT_FALSE(test::is_grounded(tiles, 2));
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::underside).size(), 8U);
}

std::vector<ClosingTriangle> closing_of(const std::vector<std::vector<Point3f>>& polygons) {
  Tile tile;
  for (const auto& polygon : polygons) tile.add_polygon(polygon, 0);
  std::vector<ClosingTriangle> closing;
  EXPECT_THAT(without_contacts(border, tile, closing), IsEmpty());
  return closing;
}

TEST(Contacts, WhatMeetsTheBorderLeavesNoCrack) {
  EXPECT_THAT(closing_of({upright(4, 2, 12, 0, 5)}), IsEmpty());
  EXPECT_THAT(closing_of({level(0, 0, 20, 20, 5)}), IsEmpty());
  // Nor does something farther away beside it
  EXPECT_THAT(closing_of({upright(4, 2, 12, 0, 5), upright(4.01F, 2, 12, 0, 5), level(0, 0, 20, 20, 4.99F)}), IsEmpty());
}

TEST(Contacts, ACrackIsClosedFromTheBorderToWhatIsNearest) {
  const float gap_m = 0.01F;
  using Polygons = std::vector<std::vector<Point3f>>;
  for (const Polygons& polygons : {Polygons{level(0, 0, 20, 20, 5 - gap_m)}, Polygons{upright(4 + gap_m, 0, 20, 0, 9)},
                                   Polygons{upright(4 + gap_m, 0, 20, 0, 9), upright(3.985F, 0, 20, 0, 9)}}) {
    const std::vector<ClosingTriangle> closing = closing_of(polygons);
    constexpr double rounding = 1e-5;
    EXPECT_NEAR(area_m2(closing), 10.0 * gap_m, rounding);
    for (const ClosingTriangle& t : closing)
      for (const Point3d& p : t) {
        EXPECT_TRUE(p.x >= 2.0 - rounding && p.x <= 12.0 + rounding) << p.x;
        EXPECT_LE(std::hypot(p.y - 4.0, p.z - 5.0), gap_m + rounding);
      }
  }
}

TEST(Contacts, WhereOneTriangleEndsTheNextOneGoesOn) {
  // Two walls, one before the other: at x = 7, the way leads from one to the other
  const auto closing = closing_of({upright(4.01F, 0, 7, 0, 5), upright(4.005F, 7, 20, 0, 5)});
  const auto reaches = [&](double y) {
    return std::any_of(closing.begin(), closing.end(), [&](const ClosingTriangle& t) {
      return std::any_of(t.begin(), t.end(), [&](const Point3d& p) { return std::abs(p.y - y) < 1e-5; });
    });
  };
  EXPECT_TRUE(reaches(4.01) && reaches(4.005));
}

}  // namespace
}  // namespace farlod::tiles
