// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "tests/preprocess/tiles/borders.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {
namespace {

using test::as_set;
using test::Face;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Segment3d> undersides_of(const std::vector<Face>& faces) {
  const auto borders = undersides(test::table_of(faces).edges());
  for (const HorizonSegment& e : borders) EXPECT_EQ(e.role, EdgeRole::underside);
  return as_set(test::segments_of(borders));
}

/// Those that do not lie on the ground.
std::vector<Segment3d> raised_undersides_of(const std::vector<Face>& faces) {
  std::vector<Segment3d> borders = undersides_of(faces);
  std::erase_if(borders, [](const Segment3d& s) { return s.a.z == 0.0 && s.b.z == 0.0; });
  return borders;
}

std::vector<Segment3d> rectangle(double x0, double y0, double x1, double y1, double z) {
  return as_set({{{x0, y0, z}, {x1, y0, z}}, {{x1, y0, z}, {x1, y1, z}}, {{x0, y1, z}, {x1, y1, z}}, {{x0, y0, z}, {x0, y1, z}}});
}

TEST(Undersides, OfABridgeAreItsBottomEdges) {
  EXPECT_EQ(undersides_of(test::box(0, 0, 10, 20, 4, 7)), rectangle(0, 0, 10, 20, 4));
}

TEST(Undersides, OfClosedBodiesOnTheGroundLieOnTheGround) {
  EXPECT_EQ(undersides_of(test::box(0, 0, 10, 20, 0, 5)), rectangle(0, 0, 10, 20, 0));
  EXPECT_EQ(undersides_of(test::gabled_house()), rectangle(0, 0, 20, 10, 0));
  EXPECT_THAT(raised_undersides_of(test::stepped_box()), IsEmpty());
}

TEST(Undersides, WithoutAFloorTheWallsEndWhereTheyEndedWithIt) {
  auto faces = test::gabled_house();
  faces.pop_back();
  EXPECT_EQ(undersides_of(faces), rectangle(0, 0, 20, 10, 0));
}

TEST(Undersides, OfTiesAndOverhangsAreTheirSoffitsBorders) {
  // An upper floor that projects by 2 m to the south
  const std::vector<Face> house{
      {{0, -2, 6}, {10, -2, 6}, {10, 10, 6}, {0, 10, 6}},  {{0, -2, 3}, {0, 0, 3}, {10, 0, 3}, {10, -2, 3}},  // the soffit
      {{0, 0, 0}, {10, 0, 0}, {10, 0, 3}, {0, 0, 3}},      {{0, -2, 3}, {10, -2, 3}, {10, -2, 6}, {0, -2, 6}},
      {{10, 10, 0}, {0, 10, 0}, {0, 10, 6}, {10, 10, 6}},  {{10, 0, 0}, {10, 10, 0}, {10, 10, 6}, {10, 0, 3}},
      {{10, 0, 3}, {10, 10, 6}, {10, -2, 6}, {10, -2, 3}}, {{0, 10, 0}, {0, 0, 0}, {0, 0, 3}, {0, 10, 6}},
      {{0, 10, 6}, {0, 0, 3}, {0, -2, 3}, {0, -2, 6}}};
  EXPECT_EQ(raised_undersides_of(house), as_set({{{0, -2, 3}, {10, -2, 3}}, {{0, -2, 3}, {0, 0, 3}}, {{10, -2, 3}, {10, 0, 3}}}));
}

TEST(Undersides, OfAnEaveSheetAreWhereItEnds) {
  auto faces = test::box(0, 0, 10, 20, 0, 5);
  faces.push_back({{-1, 0, 5}, {0, 0, 5}, {0, 20, 5}, {-1, 20, 5}});
  EXPECT_EQ(raised_undersides_of(faces), as_set({{{-1, 0, 5}, {-1, 20, 5}}, {{-1, 0, 5}, {0, 0, 5}}, {{-1, 20, 5}, {0, 20, 5}}}));
}

TEST(Undersides, OfAMissingWallAreTheOpeningsUpperEdge) {
  auto faces = test::box(0, 0, 10, 20, 0, 5);
  faces.erase(faces.begin() + 1);
  EXPECT_THAT(raised_undersides_of(faces), ElementsAre(Segment3d{{0, 0, 5}, {10, 0, 5}}));
}

TEST(Undersides, OfALeaningWallAreItsTopAndCornersWhereItLeansByMoreThanTheErrorOfSurveys) {
  // A house 20 m high whose east wall leans out, always by less than 0.6°
  const auto leaning = [](double by_m) {
    return std::vector<Face>{{{0, 0, 20}, {10 + by_m, 0, 20}, {10 + by_m, 8, 20}, {0, 8, 20}},
                             {{0, 0, 0}, {0, 8, 0}, {10, 8, 0}, {10, 0, 0}},
                             {{10, 0, 0}, {10, 8, 0}, {10 + by_m, 8, 20}, {10 + by_m, 0, 20}},
                             {{0, 0, 0}, {0, 0, 20}, {0, 8, 20}, {0, 8, 0}},
                             {{0, 0, 0}, {10, 0, 0}, {10 + by_m, 0, 20}, {0, 0, 20}},
                             {{0, 8, 0}, {0, 8, 20}, {10 + by_m, 8, 20}, {10, 8, 0}}};
  };
  EXPECT_THAT(raised_undersides_of(leaning(0.8 * max_lean_m)), IsEmpty());
  const double by_m = 3.0 * max_lean_m;
  EXPECT_EQ(
      raised_undersides_of(leaning(by_m)),
      as_set({{{10 + by_m, 0, 20}, {10 + by_m, 8, 20}}, {{10, 0, 0}, {10 + by_m, 0, 20}}, {{10, 8, 0}, {10 + by_m, 8, 20}}}));
}

TEST(Undersides, OfASheetOfWallAreItsFoot) {
  EXPECT_THAT(undersides_of({{{0, 0, 2}, {10, 0, 2}, {10, 0, 5}, {0, 0, 5}}}), ElementsAre(Segment3d{{0, 0, 2}, {10, 0, 2}}));
}

TEST(Undersides, AnEdgeThatLeavesFromItsEndClosesNothing) {
  // A pier whose sides lean inwards by 0.2 m on 20 m: near to its foot, the edges at its corners hardly leave the foot's
  const auto corner = [](int n, double inset_m, double z) {
    return Point3d{n % 4 == 1 || n % 4 == 2 ? 10 - inset_m : inset_m, n % 4 >= 2 ? 10 - inset_m : inset_m, z};
  };
  std::vector<Face> pier{{corner(3, 0, 4), corner(2, 0, 4), corner(1, 0, 4), corner(0, 0, 4)},
                         {corner(0, 0.2, 24), corner(1, 0.2, 24), corner(2, 0.2, 24), corner(3, 0.2, 24)}};
  for (int n = 0; n < 4; ++n) pier.push_back({corner(n, 0, 4), corner(n + 1, 0, 4), corner(n + 1, 0.2, 24), corner(n, 0.2, 24)});
  EXPECT_EQ(undersides_of(pier), rectangle(0, 0, 10, 10, 4));
}

TEST(Undersides, ATJunctionCloses) { EXPECT_THAT(raised_undersides_of(test::box_with_t_junctions()), IsEmpty()); }

/// A wall from 3 to 6 m in three strips, above a wall in some strips of its own.
std::vector<Face> strips(const std::vector<std::pair<double, double>>& below) {
  std::vector<Face> faces;
  for (const double x : {0.0, 4.0, 8.0}) faces.push_back({{x, 0, 3}, {x + 4, 0, 3}, {x + 4, 0, 6}, {x, 0, 6}});
  for (const auto& [from, to] : below) faces.push_back({{from, 0, 0}, {to, 0, 0}, {to, 0, 3}, {from, 0, 3}});
  return faces;
}

TEST(Undersides, ALongEdgeClosesAChainOfShorterOnes) { EXPECT_THAT(raised_undersides_of(strips({{0, 12}})), IsEmpty()); }

TEST(Undersides, AChainThatMissesAPartLeavesThatOpen) {
  const auto open = raised_undersides_of(strips({{0, 3}, {9, 12}}));
  double length_m = 0.0;
  for (const Segment3d& s : open) {
    EXPECT_GE(std::min(s.a.x, s.b.x), 3.0 - on_line_m);
    EXPECT_LE(std::max(s.a.x, s.b.x), 9.0 + on_line_m);
    length_m += norm(s.b - s.a);
  }
  EXPECT_NEAR(length_m, 6.0, 4.0 * on_line_m);
}

TEST(Undersides, AWallBesideItClosesNothing) {
  auto faces = strips({});
  for (const double y : {-0.1, 0.1}) faces.push_back({{0, y, 0}, {12, y, 0}, {12, y, 3}, {0, y, 3}});
  EXPECT_EQ(raised_undersides_of(faces).size(), 3U);
}

/// A sheet over 10 × 10 m in two triangles, whose diagonal lies lower than its other corners by this.
std::vector<Face> bent_sheet(double fall_m, bool looks_up) {
  const Point3d a{0, 0, 5}, b{10, 0, 5 + fall_m}, c{10, 10, 5}, d{0, 10, 5 + fall_m};
  if (looks_up) return {{a, b, c}, {a, c, d}};
  return {{a, c, b}, {a, d, c}};
}

TEST(Undersides, TheDiagonalOfABentRoofIsNone) {
  const Segment3d diagonal{{0, 0, 5}, {10, 10, 5}};
  // 7 m to either side; both sides together bend by less than slight_bend_rad
  const double slight_fall_m = 0.45 * slight_bend_rad * std::sqrt(50.0);
  for (const bool looks_up : {false, true}) {
    EXPECT_EQ(undersides_of(bent_sheet(slight_fall_m, looks_up)).size(), 4U);
    EXPECT_THAT(undersides_of(bent_sheet(-1.0, looks_up)), testing::Not(testing::Contains(diagonal))) << "a vault";
  }
  EXPECT_THAT(undersides_of(bent_sheet(1.0, true)), testing::Contains(diagonal)) << "a valley, seen below the ends of the sheet";
  EXPECT_THAT(undersides_of(bent_sheet(1.0, false)), testing::Contains(diagonal)) << "a sagging soffit";
}

TEST(Undersides, WhereAFacetEndsNothingIsBesideItOnOneSide) {
  for (const HorizonSegment& e : undersides(test::table_of({{{0, 0, 5}, {0, 10, 5}, {10, 10, 5}, {10, 0, 5}}}).edges()))
    EXPECT_NE(e.adjacent.left == AdjacentSlopes::straight_up, e.adjacent.right == AdjacentSlopes::straight_up);
}

TEST(Undersides, RisesAreTheFlattestFacetsAndALittleMore) {
  const auto borders = undersides(test::table_of(test::box(0, 0, 10, 20, 4, 7)).edges());
  const std::int8_t give = AdjacentSlopes::rounded_up(4.0 * slight_bend_rad);
  ASSERT_EQ(borders.size(), 4U);
  for (const HorizonSegment& e : borders) {
    // Of the way from a to b, the soffit lies to the left if the middle of the bridge does
    const Point3d along = e.segment.b - e.segment.a, in = Point3d{5, 10, 4} - e.segment.a;
    const bool left = along.x * in.y - along.y * in.x > 0.0;
    EXPECT_EQ(left ? e.adjacent.left : e.adjacent.right, give);
    EXPECT_EQ(left ? e.adjacent.right : e.adjacent.left, AdjacentSlopes::straight_up);
  }
}

TEST(Undersides, TheTileStageKeepsThoseAboveTheGround) {
  test::SmallTown town;
  town.add("house", test::box(1, 1, 21, 11, 0, 9));
  town.add("bridge", test::box(25, 5, 45, 9, 4, 7));
  const TileSet tiles = town.tiles();
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::underside), rectangle(25, 5, 45, 9, 4));
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::overhang), rectangle(25, 5, 45, 9, 7));
  EXPECT_TRUE(test::is_grounded(tiles, 1));
  EXPECT_FALSE(test::is_grounded(tiles, 2));
}

/// A lower border 10 m long, 5 m up, along the x axis.
const HorizonEdge border{{2, 4, 5}, {12, 4, 5}, {3, AdjacentSlopes::straight_up}, EdgeRole::underside};

std::vector<HorizonEdge> open_parts(const std::vector<std::vector<Point3f>>& polygons) {
  Tile tile;
  for (const auto& polygon : polygons) tile.add_polygon(polygon, 0);
  return without_contacts(border, tile);
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

}  // namespace
}  // namespace farlod::tiles
