// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/horizon_edges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "tests/preprocess/tiles/borders.hpp"
#include "tests/preprocess/tiles/whole_ground.hpp"
#include "tiles/ground.hpp"

namespace farlod::tiles {
namespace {

using test::Face;
using test::segments_of;
using test::table_of;
using testing::UnorderedElementsAre;

std::vector<Segment3d> horizon_edges_of(const std::vector<Face>& faces) { return segments_of(table_of(faces).horizon_edges()); }

/// What rises beside an edge, to the left and to the right of the way from a to b.
AdjacentSlopes slopes_beside(const std::vector<HorizonSegment>& edges, const Segment3d& ab) {
  for (const auto& [segment, adjacent, role] : edges) {
    EXPECT_EQ(role, EdgeRole::grounded) << "what overhangs is not known here";
    if (segment == ab) return adjacent;
    if (segment == Segment3d{ab.b, ab.a}) return {adjacent.right, adjacent.left};
  }
  ADD_FAILURE() << "no such edge";
  return {};
}

/// Each edge from west to east, or from south to north: which end comes first means nothing.
std::vector<Segment3d> directed(std::vector<Segment3d> edges) {
  for (Segment3d& e : edges)
    if (std::pair(e.b.x, e.b.y) < std::pair(e.a.x, e.a.y)) std::swap(e.a, e.b);
  return edges;
}

TEST(HorizonEdges, OfABoxAreItsFourTopEdges) {
  EXPECT_THAT(horizon_edges_of(test::box(0, 0, 10, 20, 0, 5)),
              UnorderedElementsAre(Segment3d{{0, 0, 5}, {10, 0, 5}}, Segment3d{{0, 20, 5}, {10, 20, 5}},
                                   Segment3d{{0, 0, 5}, {0, 20, 5}}, Segment3d{{10, 0, 5}, {10, 20, 5}}));
}

TEST(HorizonEdges, OfAGabledHouseAreRidgeEavesAndGables) {
  EXPECT_THAT(horizon_edges_of(test::gabled_house()),
              UnorderedElementsAre(Segment3d{{0, 5, 9}, {20, 5, 9}},                                         // ridge
                                   Segment3d{{0, 0, 6}, {20, 0, 6}}, Segment3d{{0, 10, 6}, {20, 10, 6}},     // eaves
                                   Segment3d{{0, 0, 6}, {0, 5, 9}}, Segment3d{{0, 5, 9}, {0, 10, 6}},        // west gable
                                   Segment3d{{20, 0, 6}, {20, 5, 9}}, Segment3d{{20, 5, 9}, {20, 10, 6}}));  // east gable
}

TEST(HorizonEdges, LeaveOutTheConcaveFootOfAHigherPart) {
  const Segment3d foot{{10, 0, 5}, {10, 10, 5}};
  const auto edges = horizon_edges_of(test::stepped_box());
  EXPECT_THAT(edges, testing::Not(testing::Contains(foot)));
  EXPECT_EQ(edges.size(), 7U);  // three of the low roof, four of the high one
}

TEST(HorizonEdges, LeaveOutTheValleyBetweenTwoSlopesButKeepTheRidge) {
  const Face left{{0, 0, 1}, {5, 0, 0}, {5, 9, 0}, {0, 9, 1}}, right{{5, 0, 0}, {10, 0, 1}, {10, 9, 1}, {5, 9, 0}};
  const Segment3d fold{{5, 0, 0}, {5, 9, 0}};
  EXPECT_THAT(horizon_edges_of({left, right}), testing::Not(testing::Contains(fold)));
  const auto turned_over = [](Face face) {
    for (Point3d& p : face) p.z = -p.z;
    return face;
  };
  EXPECT_THAT(horizon_edges_of({turned_over(left), turned_over(right)}),
              testing::Contains(Segment3d{{5, 0, -0.0}, {5, 9, -0.0}}));
}

TEST(HorizonEdges, KeepTheTopOfAWallWithoutThickness) {
  const Face wall{{0, 0, 0}, {10, 0, 0}, {10, 0, 4}, {0, 0, 4}};
  // Drawn from both sides it is closed as far as counting goes, and must not vanish
  EXPECT_THAT(horizon_edges_of({wall, wall}), UnorderedElementsAre(Segment3d{{0, 0, 4}, {10, 0, 4}}));
}

TEST(HorizonEdges, KeepTheFoldWhereASliverLiesBetweenTheSlopes) {
  // The middle of the ridge lies a hair beside it: the triangle between has no direction to be trusted
  const Point3d a{0, 0, 3}, b{10, 0, 3}, m{5, 1e-9, 3 + 1e-9};
  EdgeTable table;
  table.add_triangle(a, b, {5, -5, 0}, FacetLook::up);
  table.add_triangle(a, m, b, FacetLook::up);
  table.add_triangle(a, {5, 5, 0}, m, FacetLook::up);
  table.add_triangle(m, {5, 5, 0}, b, FacetLook::up);
  EXPECT_THAT(segments_of(table.horizon_edges()), testing::Contains(Segment3d{a, b}));
}

TEST(AdjacentSlopes, OfAFlatRoofAreLevelInwardsAndAWallOutwards) {
  const auto edges = table_of(test::box(0, 0, 10, 20, 0, 5)).horizon_edges();
  EXPECT_EQ(slopes_beside(edges, {{0, 0, 5}, {10, 0, 5}}), (AdjacentSlopes{0, AdjacentSlopes::straight_down}));
  EXPECT_EQ(slopes_beside(edges, {{0, 20, 5}, {10, 20, 5}}), (AdjacentSlopes{AdjacentSlopes::straight_down, 0}));
  EXPECT_EQ(slopes_beside(edges, {{0, 0, 5}, {0, 20, 5}}), (AdjacentSlopes{AdjacentSlopes::straight_down, 0}));
  EXPECT_EQ(slopes_beside(edges, {{10, 0, 5}, {10, 20, 5}}), (AdjacentSlopes{0, AdjacentSlopes::straight_down}));
}

TEST(AdjacentSlopes, OfAGabledHouseAreThePitchesOfItsRoof) {
  const auto edges = table_of(test::gabled_house()).horizon_edges();
  const double pitch_rad = std::atan2(3.0, 5.0);
  const std::int8_t up = AdjacentSlopes::rounded_down(pitch_rad), down = AdjacentSlopes::rounded_down(-pitch_rad);
  EXPECT_EQ(slopes_beside(edges, {{0, 5, 9}, {20, 5, 9}}), (AdjacentSlopes{down, down}));
  EXPECT_EQ(slopes_beside(edges, {{0, 0, 6}, {20, 0, 6}}), (AdjacentSlopes{up, AdjacentSlopes::straight_down}));
  EXPECT_EQ(slopes_beside(edges, {{0, 10, 6}, {20, 10, 6}}), (AdjacentSlopes{AdjacentSlopes::straight_down, up}));
  // Along a gable's edge the roof climbs, but not away from it
  EXPECT_EQ(slopes_beside(edges, {{0, 0, 6}, {0, 5, 9}}), (AdjacentSlopes{AdjacentSlopes::straight_down, 0}));
}

TEST(AdjacentSlopes, WhereNoTriangleIsAreUnknown) {
  EdgeTable table;
  table.add_triangle({0, 0, 5}, {10, 0, 5}, {5, 10, 4}, FacetLook::up);
  EXPECT_EQ(slopes_beside(table.horizon_edges(), {{0, 0, 5}, {10, 0, 5}}).right, AdjacentSlopes::straight_down);
}

TEST(AdjacentSlopes, OfAHillArePlainAndSlope) {
  // A dam along the x axis, 2 m high, whose sides climb at 45° and at less
  const Ground ground({{0, 50, 2}, {100, 50, 2}, {0, 48, 0}, {100, 48, 0}, {0, 60, 0}, {100, 60, 0}}, {{0, 0}, {100, 100}});
  const auto edges = test::horizon_edges_of(ground);
  const std::int8_t steep = AdjacentSlopes::rounded_down(-std::atan(1.0)),
                    gentle = AdjacentSlopes::rounded_down(-std::atan2(2.0, 10.0));
  EXPECT_EQ(slopes_beside(edges, {{0, 50, 2}, {100, 50, 2}}), (AdjacentSlopes{gentle, steep}));
  EXPECT_EQ(slopes_beside(edges, {{0, 0, 0}, {100, 0, 0}}), (AdjacentSlopes{0, AdjacentSlopes::straight_down}));
}

TEST(HorizonEdges, ComeInTheOrderOfTheirTriangles) {
  auto faces = test::gabled_house();
  const auto edges = horizon_edges_of(faces);
  faces.insert(faces.end(), faces.begin(), faces.end());  // what comes twice is not there twice
  const auto twice = horizon_edges_of(faces);
  EXPECT_EQ(edges, twice);
}

TEST(HorizonEdges, OfAHillAreItsRibsAndTheBorder) {
  // A pyramid of four sides in the middle of a plain
  std::vector<Point3d> points{{50, 50, 10}, {40, 40, 0}, {60, 40, 0}, {60, 60, 0}, {40, 60, 0}};
  const Ground ground(points, {{0, 0}, {100, 100}});
  EXPECT_THAT(directed(segments_of(test::horizon_edges_of(ground))),
              UnorderedElementsAre(Segment3d{{40, 40, 0}, {50, 50, 10}}, Segment3d{{50, 50, 10}, {60, 40, 0}},
                                   Segment3d{{50, 50, 10}, {60, 60, 0}}, Segment3d{{40, 60, 0}, {50, 50, 10}},
                                   Segment3d{{0, 0, 0}, {100, 0, 0}}, Segment3d{{0, 100, 0}, {100, 100, 0}},
                                   Segment3d{{0, 0, 0}, {0, 100, 0}}, Segment3d{{100, 0, 0}, {100, 100, 0}}));
}

TEST(HorizonEdges, OfFlatGroundAreItsBorder) {
  EXPECT_EQ(test::horizon_edges_of(Ground({{20, 30, 5}, {70, 60, 5}, {40, 80, 5}}, {{0, 0}, {100, 100}})).size(), 4U);
}

class CutEdge : public testing::Test {
 protected:
  static Grid grid() {
    Grid grid;
    grid.cell_edge_m = 50.0;
    return grid;
  }
  static Point3d grid_from_cell(const Point3f& p, Cell cell) {
    const Point2d corner = grid().corner_of(cell);
    return {p.x + corner.x, p.y + corner.y, static_cast<double>(p.z)};
  }
  static double length_m(const CellEdge& e) { return norm(grid_from_cell(e.edge.b, e.cell) - grid_from_cell(e.edge.a, e.cell)); }
};

TEST_F(CutEdge, PiecesLieInTheirCellsAndTheirLengthsSumToItsOwn) {
  const Segment3d edge{{-37.3, 12.9, 3}, {212.8, 171.4, 60}};
  const auto pieces = cut_edge({edge, {-31, 17}, EdgeRole::underside}, grid(), 0.0);
  ASSERT_EQ(pieces.size(), 9U);  // five columns (−1 to 4: five borders), three borders of rows
  double sum_m = 0.0;
  for (const CellEdge& piece : pieces) {
    sum_m += length_m(piece);
    EXPECT_EQ(piece.edge.adjacent, (AdjacentSlopes{-31, 17}));
    EXPECT_EQ(piece.edge.role, EdgeRole::underside);
    EXPECT_GT(piece.edge.b.x, piece.edge.a.x) << "turned round, left would be right";
    for (const Point3f& p : {piece.edge.a, piece.edge.b}) {
      const Point3d p_grid = grid_from_cell(p, piece.cell);
      // A crossing is rounded once in double, then as a float in the cell
      const double rounding_m = 50.0 * std::numeric_limits<float>::epsilon();
      const Box2d square = grid().square_of(piece.cell);
      EXPECT_GE(p_grid.x, square.low.x - rounding_m);
      EXPECT_LE(p_grid.x, square.high.x + rounding_m);
      EXPECT_GE(p_grid.y, square.low.y - rounding_m);
      EXPECT_LE(p_grid.y, square.high.y + rounding_m);
    }
  }
  // Both ends of each piece are rounded in three coordinates of at most 60 m
  const double rounding_m = std::sqrt(3.0) * 60.0 * std::numeric_limits<float>::epsilon();
  EXPECT_NEAR(sum_m, norm(edge.b - edge.a), static_cast<double>(pieces.size()) * rounding_m);
}

TEST_F(CutEdge, AlongABorderItBelongsToTheCellToTheEast) {
  const auto pieces = cut_edge({{{50, 10, 3}, {50, 70, 3}}, {}}, grid(), 0.0);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].cell, (Cell{1, 0}));
  EXPECT_EQ(pieces[1].cell, (Cell{1, 1}));
}

TEST_F(CutEdge, ThatOnlyEndsOnABorderStaysWhole) {
  const auto pieces = cut_edge({{{10, 10, 3}, {50, 10, 3}}, {5, -5}}, grid(), 2.0);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].cell, (Cell{0, 0}));
  EXPECT_EQ(pieces[0].edge, (HorizonEdge{{10, 10, 1}, {50, 10, 1}, {5, -5}}));
}

}  // namespace
}  // namespace farlod::tiles
