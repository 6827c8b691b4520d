// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "tests/determinism/threads.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"
#include "tiles/tile_filler.hpp"

namespace farlod::tiles {
namespace {

using scenes::SceneBuilder;

TileSet tiles_of(const CityModel& city, const Grid& grid, Assign assign = Assign::clip,
                 const std::optional<TerrainRaster>& terrain = {}, Report* report = nullptr) {
  Report ignored;
  return cut_into_tiles({city, {}}, grid, assign, terrain, report != nullptr ? *report : ignored);
}

/// Area of a surface by its triangles in all tiles.
double area_in_tiles(const TileSet& tiles, std::uint32_t surface) {
  double sum = 0.0;
  for (const Tile& tile : tiles.tiles)
    for (std::size_t n = 0; n < tile.triangles.size(); ++n) {
      if (tile.triangle_surfaces[n] != surface) continue;
      const auto corner = [&](std::uint32_t v) { return Point3d{tile.vertices[v].x, tile.vertices[v].y, tile.vertices[v].z}; };
      const Triangle& t = tile.triangles[n];
      sum += 0.5 * norm(cross(corner(t.b) - corner(t.a), corner(t.c) - corner(t.a)));
    }
  return sum;
}

/// A triangle's area moves by its perimeter times the rounding of its corners; a surface of `area` in cells of `edge` is cut into
/// pieces whose perimeters add up to less than 8·area/edge + the surface's own four sides, taken twice.
double rounding_of_area(double area_m2, double edge_m, double extent_m) {
  const double corner = edge_m * std::numeric_limits<float>::epsilon() + extent_m * std::numeric_limits<float>::epsilon();
  return corner * (8 * area_m2 / edge_m + 8 * extent_m + 8 * edge_m);
}

TEST(Tiles, HoldEverySurfaceWhole) {
  SceneBuilder town;
  town.add_box({{3, 4}, {177, 93}}, 0.0, 31.0);
  for (const double bearing_deg : {0.0, 28.3}) {
    const Grid grid = scenes::grid_covering(town.city(), Angle::degrees(bearing_deg), 33.3, 3);
    const TileSet tiles = tiles_of(town.city(), grid);
    ASSERT_EQ(tiles.surfaces.size(), 7U);  // the ground and six sides
    for (std::uint32_t s = 0; s < 7; ++s)
      EXPECT_NEAR(area_in_tiles(tiles, s), tiles.surfaces[s].area_m2, rounding_of_area(tiles.surfaces[s].area_m2, 33.3, 200))
          << s;
    // Roof and floor first, then the walls south, east, north and west
    EXPECT_NEAR(tiles.surfaces[1].area_m2, 174.0 * 89, rounding_of_area(174.0 * 89, 33.3, 200));
    EXPECT_NEAR(tiles.surfaces[3].area_m2, 174.0 * 31, rounding_of_area(174.0 * 31, 33.3, 200));
  }
}

TEST(Tiles, KnowBuildingAndKindAndOutwardNormalOfEachSurface) {
  SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 5.0);
  town.add_box({{20, 0}, {30, 10}}, 0.0, 5.0);
  const TileSet tiles = tiles_of(town.city(), scenes::grid_covering(town.city(), {}, 50, 3));
  EXPECT_EQ(tiles.building_ids, (std::vector<std::string>{"box 0", "box 1"}));
  EXPECT_EQ(tiles.surfaces[ground_surface].kind, SurfaceKind::ground);
  std::map<SurfaceKind, int> kinds;
  for (const Surface& s : tiles.surfaces) ++kinds[s.kind];
  EXPECT_EQ(kinds[SurfaceKind::roof], 2);
  EXPECT_EQ(kinds[SurfaceKind::floor], 2);
  EXPECT_EQ(kinds[SurfaceKind::wall], 8);
  EXPECT_EQ(tiles.surfaces[3].normal, (Point3d{0, -1, 0}));  // the south wall of the first box
  EXPECT_EQ(tiles.surfaces[3].building, 0U);
  EXPECT_EQ(tiles.surfaces[9].building, 1U);
}

TEST(Tiles, AssignWholePutsABuildingIntoOneTile) {
  SceneBuilder town;
  town.add_box({{40, 10}, {90, 20}}, 0.0, 12.0);  // its centroid is at x = 65
  const Grid grid = scenes::grid_covering(town.city(), {}, 50, 3);
  const TileSet tiles = tiles_of(town.city(), grid, Assign::whole);
  std::set<std::size_t> holders;
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n)
    for (const std::uint32_t s : tiles.tiles[n].triangle_surfaces)
      if (s != ground_surface) holders.insert(n);
  EXPECT_EQ(holders, (std::set<std::size_t>{grid.cells.index_of({1, 0})}));
}

TEST(Tiles, EveryFacetIsKeptOrInTheReport) {
  CityModel city;
  city.begin_building("odd");
  std::uint32_t n = 0;
  const auto add = [&](const std::vector<Point3d>& ring) {
    city.begin_facet(SurfaceKind::unknown, n++);
    city.add_ring(ring);
  };
  add({{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}});
  add({{0, 0, 0}, {5, 0, 0}, {9, 0, 0}});
  add({{0, 0, 3}, {4, 4, 3}, {4, 0, 3}, {0, 6, 3}});
  add({{0, 0, 0}, {10, 0, 0}, {10, 10, 1}, {0, 10, 0}});
  Report report;
  const TileSet tiles = tiles_of(city, scenes::grid_covering(city, {}, 50, 3), Assign::clip, {}, &report);
  EXPECT_EQ(tiles.polygon_count, 3U);
  ASSERT_EQ(report.problems().size(), 3U);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::zero_area);
  EXPECT_EQ(report.problems()[1].code, ProblemCode::self_intersecting);
  EXPECT_EQ(report.problems()[2].code, ProblemCode::not_planar);
  for (const Problem& p : report.problems()) EXPECT_EQ(p.place, "odd");
  EXPECT_EQ(report.problems()[2].ring, "surface 3, ring 0 (outer)");
}

TEST(Tiles, RingsAreRepairedOnlyWhereThatIsCertain) {
  using Rings = std::vector<std::vector<Point3d>>;
  const std::vector<Point3d> roof{{0, 0, 5}, {10, 0, 5}, {10, 8, 5}, {0, 8, 5}};
  const std::vector<Point3d> court{{2, 2, 5}, {4, 2, 5}, {4, 4, 5}, {2, 4, 5}}, well{{3, 3, 5}, {3.5, 3, 5}, {3, 3.5, 5}};
  const std::vector<Point3d> far{{20, 0, 5}, {22, 0, 5}, {22, 2, 5}};
  struct Case {
    Rings rings;
    double area_m2;
    ProblemCode code;
    std::string ring;
  };
  const std::vector<Case> cases{
      {{roof, far}, 80, ProblemCode::hole_outside, "surface 0, ring 1 (hole)"},
      {{roof, roof}, 80, ProblemCode::hole_outside, "surface 0, ring 1 (hole)"},
      {{roof, court, court}, 76, ProblemCode::hole_outside, "surface 0, ring 2 (hole)"},
      {{roof, court, well}, 76, ProblemCode::hole_outside, "surface 0, ring 2 (hole)"},
      {{court, roof}, 76, ProblemCode::self_intersecting, "surface 0, ring 1 (hole)"},
      {{{roof[0], roof[1], {10, 4, 5}, {13, 4, 5}, {10, 4, 5}, roof[2], roof[3]}, court},
       76,
       ProblemCode::spike,
       "surface 0, ring 0 (outer)"},
  };
  for (const Case& c : cases) {
    CityModel city;
    city.begin_building("odd");
    city.begin_facet(SurfaceKind::roof, 0);
    for (const auto& ring : c.rings) city.add_ring(ring);
    Report report;
    const TileSet tiles = tiles_of(city, scenes::grid_covering(city, Angle::degrees(20), 50, 3), Assign::clip, {}, &report);
    ASSERT_EQ(report.problems().size(), 1U) << c.ring;
    EXPECT_EQ(report.problems()[0].code, c.code);
    EXPECT_EQ(report.problems()[0].ring, c.ring);
    // The points were turned: a corner of numbers up to 25 is off by the last bit of a sum of two products
    EXPECT_NEAR(tiles.surfaces[1].area_m2, c.area_m2, 36 * 4 * 25 * std::numeric_limits<double>::epsilon()) << c.ring;
  }
}

TEST(Tiles, PlaceProblemsInTheCrsOfThePackage) {
  LocatedCity located;
  located.georeference.origin_m = {500000.0, 5500000.0};
  located.city.begin_building("odd");
  located.city.begin_facet(SurfaceKind::unknown, 0);
  located.city.add_ring(std::vector<Point3d>{{30, 20, 7}, {40, 20, 7}, {40, 30, 8}, {30, 30, 7}});
  Report report;
  const Grid grid = scenes::grid_covering(located.city, Angle::degrees(30), 50, 3);
  (void)cut_into_tiles(std::move(located), grid, Assign::clip, {}, report);
  ASSERT_EQ(report.count(ProblemCode::not_planar), 1U);
  constexpr double rounding_m = 2.0 * 9.4e-10;  // of numbers up to eight million, turned there and back
  const Point3d p = report.problems()[0].position.value();
  EXPECT_NEAR(p.x, 500030.0, rounding_m);
  EXPECT_NEAR(p.y, 5500020.0, rounding_m);
  EXPECT_EQ(p.z, 7.0);
}

bool has_underside(const Tile& tile) {
  return std::any_of(tile.horizon_edges.begin(), tile.horizon_edges.end(),
                     [](const HorizonEdge& e) { return e.role == EdgeRole::underside; });
}

TEST(Tiles, HaveUndersidesWhereSomethingOverhangsOnly) {
  SceneBuilder town;
  town.add_box({{1, 1}, {49, 20}}, 0.0, 12.0);
  town.add_box({{51, 1}, {99, 20}}, 0.0, 12.0);
  town.add_box({{90, 20}, {95, 40}}, 4.0, 7.0);  // a bridge that leads from the second house over the street
  town.add_box({{51, 40}, {99, 49}}, 0.0, 12.0);
  const Grid grid = scenes::grid_covering(town.city(), {}, 50, 3);
  const TileSet tiles = tiles_of(town.city(), grid);
  EXPECT_FALSE(has_underside(tiles.tile({0, 0})));
  EXPECT_TRUE(has_underside(tiles.tile({1, 0})));
  EXPECT_EQ(tiles.tile({1, 0}).ground_at_centre_m, 0.0F);  // the bridge does not lift the ground
}

TEST(Tiles, BuildingsThatKnowOnlyTheirHeightStandOnTheTerrain) {
  CityModel city;
  city.begin_building("house", HeightReference::on_ground);
  city.begin_facet(SurfaceKind::roof, 0);
  city.add_ring(std::vector<Point3d>{{40, 40, 9}, {60, 40, 9}, {60, 60, 9}, {40, 60, 9}});
  // A slope that rises by 1 m in 10 m to the east, from 100 m
  TerrainRaster slope{{-50, -50}, {10, 10}, 21, 21, {}};
  for (std::size_t n = 0; n < 21 * 21; ++n) slope.height_m.emplace_back(100.0F + static_cast<float>(n % 21));
  const Grid grid = scenes::grid_covering(city, {}, 50, 3);
  const TileSet tiles = tiles_of(city, grid, Assign::clip, slope);
  float roof_m = 0.0F;
  for (const Tile& tile : tiles.tiles) roof_m = std::max(roof_m, tile.z_high_m);
  // The lowest terrain under the house is at its west side, x = 40
  EXPECT_NEAR(roof_m + tiles.height_origin_m, 100.0 + 9.0 + 9.0, 200 * std::numeric_limits<float>::epsilon());
  EXPECT_NEAR(tiles.tile({0, 0}).ground_at_centre_m + tiles.height_origin_m, 107.5, 200 * std::numeric_limits<float>::epsilon());
}

TEST(Tiles, BuildingsInAGapOfTheTerrainStandOnTheGroundAroundIt) {
  CityModel city;
  city.begin_building("boathouse", HeightReference::on_ground);
  city.begin_facet(SurfaceKind::roof, 0);
  city.add_ring(std::vector<Point3d>{{45, 45, 9}, {55, 45, 9}, {55, 55, 9}, {45, 55, 9}});
  // Level ground at 100 m, and a lake of 40 m without data
  TerrainRaster terrain{{-50, -50}, {10, 10}, 21, 21, {}};
  for (std::size_t n = 0; n < 21 * 21; ++n) {
    const Point2d node = terrain.node(n % 21, n / 21);
    const bool is_lake = std::abs(node.x - 50) <= 20 && std::abs(node.y - 50) <= 20;
    terrain.height_m.push_back(is_lake ? std::nullopt : std::optional(100.0F));
  }
  const TileSet tiles = tiles_of(city, scenes::grid_covering(city, {}, 50, 3), Assign::clip, terrain);
  float roof_m = 0.0F;
  for (const Tile& tile : tiles.tiles) roof_m = std::max(roof_m, tile.z_high_m);
  EXPECT_EQ(roof_m + tiles.height_origin_m, 109.0);
}

/// 70 × 70 cells, which are 9 or 16 blocks.
Grid wide_grid() {
  Grid grid;
  grid.cells = {-35, -20, 35, 50};
  return grid;
}

/// Polygons and edges in random cells, in tiles that hold their own.
class Expected {
 public:
  explicit Expected(const Grid& grid, std::size_t polygons) : filler(grid) {
    filled.cells = own.cells = grid.cells;
    filled.tiles.resize(static_cast<std::size_t>(grid.cells.size()));
    own.tiles.resize(filled.tiles.size());
    for (std::size_t n = 0; n < polygons; ++n) add(static_cast<std::uint32_t>(n));
  }

  TileFiller filler;
  TileSet filled, own;

 private:
  void add(std::uint32_t number) {
    const Cell cell = own.cells.cell_at(random_() % own.tiles.size() / (1 + number % 7));
    std::vector<Point3f> polygon(3 + random_() % 5);
    for (Point3f& p : polygon) p = {coordinate(), coordinate(), coordinate()};
    filler.add_polygon(cell, polygon, number);
    own.tile(cell).add_polygon(polygon, number);
    const HorizonEdge edge{polygon[0], polygon[1], {3, -4}, EdgeRole::underside};
    filler.add_edge(cell, edge);
    own.tile(cell).horizon_edges.push_back(edge);
  }
  float coordinate() { return static_cast<float>(random_() % 1000) * 0.05F; }

  std::mt19937 random_{1};
};

void expect_same(const TileSet& filled, const TileSet& own) {
  ASSERT_EQ(filled.tiles.size(), own.tiles.size());
  std::size_t different = 0;
  for (std::size_t n = 0; n < own.tiles.size(); ++n) {
    const Tile &a = filled.tiles[n], &b = own.tiles[n];
    different += a.vertices == b.vertices && a.triangles == b.triangles && a.triangle_surfaces == b.triangle_surfaces &&
                         a.horizon_edges == b.horizon_edges && a.z_low_m == b.z_low_m && a.z_high_m == b.z_high_m
                     ? 0
                     : 1;
  }
  EXPECT_EQ(different, 0U);
}

TEST(TileFiller, FillsTilesAsIfPolygonsWereAddedToEach) {
  // None; a few; so many that the words of a block take several chunks, which divide polygons
  for (const std::size_t polygons : {std::size_t{0}, std::size_t{100}, std::size_t{200'000}}) {
    const Grid grid = wide_grid();
    Expected expected(grid, polygons);
    with_threads(4, [&] {
      expected.filler.fill_meshes(expected.filled);
      expected.filler.fill_edges(expected.filled);
      return 0;
    });
    expect_same(expected.filled, expected.own);
    EXPECT_EQ(expected.filled.triangle_count(), expected.own.triangle_count());
  }
}

TEST(TileFiller, EdgesMayComeAfterTheMeshes) {
  const Grid grid = wide_grid();
  Expected expected(grid, 500);
  expected.filler.fill_meshes(expected.filled);
  const HorizonEdge late{{1, 2, 3}, {4, 5, 6}, {}, EdgeRole::overhang};
  expected.filler.add_edge({30, 49}, late);
  expected.own.tile({30, 49}).horizon_edges.push_back(late);
  expected.filler.fill_edges(expected.filled);
  expect_same(expected.filled, expected.own);
}

TEST(TileSet, StaysReadableWhenItsMemoryWasGivenBack) {
  const Grid grid = wide_grid();
  Expected expected(grid, 600'000);  // more than stays in memory
  expected.filler.fill_meshes(expected.filled);
  expected.filler.fill_edges(expected.filled);
  ASSERT_GT(expected.filled.pages->vertices.size() * sizeof(Point3f), Pages::least_on_disk);
  for (const Block block : grid.blocks()) expected.filled.let_go(grid.cells_of(block));
  expect_same(expected.filled, expected.own);
  const TileSet copy = expected.filled;
  expected.filled = {};
  copy.let_go();
  expect_same(copy, expected.own);
}

}  // namespace
}  // namespace farlod::tiles
