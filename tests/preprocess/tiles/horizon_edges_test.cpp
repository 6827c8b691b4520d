// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/horizon_edges.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/preprocess/tiles/borders.hpp"
#include "tests/preprocess/tiles/whole_ground.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/ground.hpp"
#include "tiles/tiles.hpp"

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

constexpr double cell_edge_m = 50.0;

/// The highest point above an azimuth, as slope (tangent of the elevation), and how far away it is.
struct Highest {
  double slope = -std::numeric_limits<double>::infinity();
  double distance_m = 0.0;
};

/// Looks from `eye` along `ahead` (length 1, horizontal) at all edges, at what of them lies within `half_width_m` of the line of
/// sight as seen from above. The slope along an edge has no maximum between its ends.
Highest highest_of(const std::vector<Segment3d>& edges, const Point3d& eye, Point2d ahead, double half_width_m) {
  Highest highest;
  for (const Segment3d& edge : edges) {
    const Point3d a = edge.a - eye, b = edge.b - eye;
    const double aside_a = ahead.x * a.y - ahead.y * a.x, aside_b = ahead.x * b.y - ahead.y * b.x;
    if (std::min(aside_a, aside_b) > half_width_m || std::max(aside_a, aside_b) < -half_width_m) continue;
    const auto place = [&](double aside) { return std::clamp((aside - aside_a) / (aside_b - aside_a), 0.0, 1.0); };
    const bool parallel = aside_a == aside_b;
    for (const double t : {parallel ? 0.0 : place(-half_width_m), parallel ? 1.0 : place(half_width_m)}) {
      const Point3d p = a + t * (b - a);
      const double distance_m = dot(horizontal(p), ahead);
      if (distance_m > 0.0 && p.z / distance_m > highest.slope) highest = {p.z / distance_m, distance_m};
    }
  }
  return highest;
}

Point3d grid_from_cell(const Point3f& p, Point2d corner) { return {p.x + corner.x, p.y + corner.y, static_cast<double>(p.z)}; }

struct Edges {
  std::vector<Segment3d> horizon, all;
};

Edges edges_of(const TileSet& tiles, const Grid& grid) {
  Edges edges;
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    const Point2d corner = grid.corner_of(tiles.cells.cell_at(n));
    const Tile& tile = tiles.tiles[n];
    for (const HorizonEdge& e : tile.horizon_edges)
      if (e.role != EdgeRole::underside) edges.horizon.push_back({grid_from_cell(e.a, corner), grid_from_cell(e.b, corner)});
    for (const Triangle& t : tile.triangles) {
      const Point3d a = grid_from_cell(tile.vertices[t.a], corner), b = grid_from_cell(tile.vertices[t.b], corner),
                    c = grid_from_cell(tile.vertices[t.c], corner);
      edges.all.insert(edges.all.end(), {{a, b}, {b, c}, {c, a}});
    }
  }
  return edges;
}

/// How far a corner of one of the two sets can lie from the other's: each is rounded once in each coordinate.
double rounding_m(double z_high_m) {
  const double half = 0.5 * std::numeric_limits<float>::epsilon();
  return 2.0 * half * std::sqrt(2.0 * cell_edge_m * cell_edge_m + z_high_m * z_high_m);
}

/// Height of the highest triangle over a place; `edges` come in threes.
double surface_height_m(const std::vector<Segment3d>& edges, Point2d place) {
  double height_m = -std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < edges.size(); n += 3) {
    const Point3d &a = edges[n].a, &b = edges[n].b, &c = edges[n + 1].b, normal = cross(b - a, c - a);
    Box2d outline;
    for (const Point3d& p : {a, b, c}) outline.add(horizontal(p));
    if (!outline.contains(place) || normal.z == 0.0) continue;
    const auto left_of = [&](const Point3d& from, const Point3d& to) {
      return ((to.x - from.x) * (place.y - from.y) - (to.y - from.y) * (place.x - from.x)) * normal.z >= 0.0;
    };
    if (!left_of(a, b) || !left_of(b, c) || !left_of(c, a)) continue;
    height_m = std::max(height_m, a.z - (normal.x * (place.x - a.x) + normal.y * (place.y - a.y)) / normal.z);
  }
  return height_m;
}

/// The oracle: from places in the streets, on the roofs and in the air above, the upper edges of a city must be as high as all
/// its edges together. Whoever has something overhead has no horizon, and is not asked.
void expect_same_horizon(const TileSet& tiles, const Grid& grid, std::uint64_t seed) {
  const Edges edges = edges_of(tiles, grid);
  float z_high_m = 0.0F;
  for (const Tile& tile : tiles.tiles) z_high_m = std::max(z_high_m, tile.z_high_m);
  const double rounding = rounding_m(static_cast<double>(z_high_m));
  const Box2d area = grid.rectangle();
  std::mt19937_64 random(seed);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937_64::max());
  };
  for (int n = 0; n < 400; ++n) {
    const Point2d place{between(area.low.x, area.high.x), between(area.low.y, area.high.y)};
    const Point3d eye{place.x, place.y, surface_height_m(edges.all, place) + between(0.0, 0.5 * z_high_m)};
    const double azimuth = between(0.0, 2.0 * std::numbers::pi);
    const Point2d ahead{std::sin(azimuth), std::cos(azimuth)};
    const Highest all = highest_of(edges.all, eye, ahead, 0.0), near_all = highest_of(edges.all, eye, ahead, rounding);
    const Highest ours = highest_of(edges.horizon, eye, ahead, 0.0), near_ours = highest_of(edges.horizon, eye, ahead, rounding);
    // A point at this distance, moved by the rounding; and what bends by less than the tolerance, all across the city
    const double tolerance_rad = (rounding + angle_tolerance_rad * norm(area.high - area.low)) / all.distance_m;
    EXPECT_LE(std::atan(all.slope), std::atan(near_ours.slope) + tolerance_rad) << n;
    EXPECT_GE(std::atan(near_all.slope), std::atan(ours.slope) - tolerance_rad) << n;
  }
}

class HorizonOracle : public testing::TestWithParam<CitySettings> {};

TEST_P(HorizonOracle, HorizonEdgesOfATownAreAsHighAsAllEdgesTogether) {
  const CityModel city = scenes::generated_town(GetParam());
  const Grid grid = scenes::grid_covering(city, Angle::degrees(20.0), cell_edge_m, 3);
  Report ignored;
  const TileSet tiles = cut_into_tiles({city, {}}, grid, Assign::clip, {}, ignored);
  expect_same_horizon(tiles, grid, GetParam().seed);
}

CitySettings town(std::uint64_t seed, int lod, double relief_m) {
  return {.size_m = 320.0, .seed = seed, .terrain_relief_m = relief_m, .lod = lod};
}

TEST_P(HorizonOracle, AllOfATownWithoutOverhangsIsGrounded) {
  const CityModel city = scenes::generated_town(GetParam());
  Report ignored;
  const TileSet tiles =
      cut_into_tiles({city, {}}, scenes::grid_covering(city, Angle::degrees(20.0), cell_edge_m, 3), Assign::clip, {}, ignored);
  std::set<std::uint32_t> overhanging;
  for (const Surface& s : tiles.surfaces)
    if (!s.grounded) overhanging.insert(s.building);
  EXPECT_EQ(overhanging.size(), 0U) << "of " << tiles.building_ids.size() << " buildings";
}

INSTANTIATE_TEST_SUITE_P(Towns, HorizonOracle,
                         testing::Values(town(1, 1, 0.0), town(2, 1, 0.0), town(3, 2, 0.0), town(4, 2, 0.0), town(5, 2, 20.0)),
                         [](const auto& instance) { return "seed_" + std::to_string(instance.param.seed); });

TEST(HorizonOracle, HorizonEdgesOfATerrainAreAsHighAsAllEdgesTogether) {
  // Rough land that reaches beyond the grid in the south and west, and ends before it in the north and east
  TerrainRaster terrain{{-30, -30}, {4, 4}, 40, 40, {}};
  std::mt19937_64 random(7);
  for (std::size_t n = 0; n < 40 * 40; ++n) terrain.height_m.emplace_back(static_cast<float>(random() % 100) / 8.0F);
  Grid grid;
  grid.cell_edge_m = cell_edge_m;
  grid.cells = {0, 0, 3, 3};
  Report ignored;
  expect_same_horizon(cut_into_tiles({}, grid, Assign::clip, terrain, ignored), grid, 7);
}

}  // namespace
}  // namespace farlod::tiles
