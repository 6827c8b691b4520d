// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "tests/preprocess/tiles/borders.hpp"
#include "tiles/contacts.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {
namespace {

using test::as_set;
using test::Face;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<HorizonSegment> borders_of(const std::vector<Face>& faces) {
  std::vector<ClosingTriangle> closing;
  return undersides(test::table_of(faces).edges(), closing);
}

std::vector<Segment3d> undersides_of(const std::vector<Face>& faces) {
  const auto borders = borders_of(faces);
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
  for (const HorizonSegment& e : borders_of({{{0, 0, 5}, {0, 10, 5}, {10, 10, 5}, {10, 0, 5}}}))
    EXPECT_NE(e.adjacent.left == AdjacentSlopes::straight_up, e.adjacent.right == AdjacentSlopes::straight_up);
}

TEST(Undersides, RisesAreTheFlattestFacetsAndALittleMore) {
  const auto borders = borders_of(test::box(0, 0, 10, 20, 4, 7));
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

TEST(Undersides, EdgesOnALineThatAreOffByAMillimetreAreJoinedAcrossTheCrack) {
  const auto wall_below = [](double top_m) {
    std::vector<ClosingTriangle> closing;
    EXPECT_EQ(undersides(test::table_of({{{0, 0, 3}, {10, 0, 3}, {10, 0, 6}, {0, 0, 6}},
                                         {{-2, 0, 0}, {12, 0, 0}, {12, 0, top_m}, {-2, 0, top_m}}})
                             .edges(),
                         closing)
                  .size(),
              1U)
        << "the foot of the wall below alone";
    return closing;
  };
  EXPECT_THAT(wall_below(3.0), IsEmpty());
  EXPECT_NEAR(test::area_m2(wall_below(2.999)), 10 * 0.001, 1e-9);
}

}  // namespace
}  // namespace farlod::tiles
