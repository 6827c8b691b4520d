// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/paging/page_file.hpp"
#include "base/paging/paged_heap.hpp"
#include "city/city_model.hpp"
#include "tests/preprocess/city/temporary_files.hpp"
#include "tests/preprocess/tiles/whole_ground.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"
#include "tiles/building_bases.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles {
namespace {

const Box2d around{{0, 0}, {100, 100}};

double covered_area(const Ground& ground) {
  double sum = 0.0;
  for (const auto& t : test::triangles_of(ground)) {
    const double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]).z;
    EXPECT_GT(area, 0.0);
    sum += area;
  }
  return sum;
}

TEST(Ground, PassesThroughItsPointsAndCoversItsRectangle) {
  const std::vector<Point3d> points{{20, 30, 5}, {70, 60, 8}, {40, 80, 2}};
  const Ground ground(points, around);
  for (const Point3d& p : points) EXPECT_DOUBLE_EQ(ground.height_at(horizontal(p)), p.z);
  // Six triangles of sums and products of a few digits each
  EXPECT_NEAR(covered_area(ground), 1e4, 1e4 * 16 * std::numeric_limits<double>::epsilon());
}

TEST(Ground, TheLowestOfTwoPointsAtOnePlaceCounts) {
  EXPECT_DOUBLE_EQ(Ground({{50, 50, 9}, {50, 50, 4}}, around).height_at({50, 50}), 4.0);
}

TEST(Ground, ItsCornersHaveTheHeightOfTheNearestPoint) {
  const Ground ground({{10, 10, 1}, {90, 90, 7}}, around);
  EXPECT_DOUBLE_EQ(ground.height_at({0, 0}), 1.0);
  EXPECT_DOUBLE_EQ(ground.height_at({100, 100}), 7.0);
}

TEST(Ground, DoesNotDependOnTheOrderOfItsPoints) {
  std::vector<Point3d> points;
  for (int n = 0; n < 60; ++n)
    points.push_back({static_cast<double>(n * 37 % 100), static_cast<double>(n * 53 % 100), static_cast<double>(n % 9)});
  const Ground there(points, around);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(test::triangles_of(there), test::triangles_of(Ground(points, around)));
}

TEST(Ground, ItsEdgesDoNotDependOnWhereInMemoryItLies) {
  std::vector<Point3d> points;
  for (int n = 0; n < 900; ++n)
    points.push_back(
        {static_cast<double>(n * 37 % 100) + 1e-3 * n, static_cast<double>(n * 53 % 97), static_cast<double>(n % 9)});
  const Ground first(points, around);
  std::vector<Ground> others;  // all alive at once, in memory that small holes break up
  std::vector<std::vector<char>> holes;
  for (std::size_t n = 1; n < 12; ++n) {
    for (std::size_t k = 0; k < 40; ++k) holes.emplace_back(n * 977 * (k % 7 + 1));
    if (n % 3 == 0) holes.clear();
    others.emplace_back(points, around);
    EXPECT_EQ(test::horizon_edges_of(others.back()), test::horizon_edges_of(first));
  }
  EXPECT_GT(test::horizon_edges_of(first).size(), 500U);
}

TEST(Ground, IsTheSameOnDiskAsInMemory) {
  std::vector<Point3d> points;  // of a lattice: four of a square lie on a circle
  for (int n = 0; n < 600 * 400; ++n)
    points.push_back({static_cast<double>(n % 600), static_cast<double>(n / 600), static_cast<double>(n * 7 % 11)});
  const Ground on_disk(points, around);
  const std::size_t bytes_on_disk = PagedHeap::bytes_on_disk();
  EXPECT_GT(bytes_on_disk, std::size_t{10} << 20);
  const farlod::test::TemporaryFiles files("/nowhere/at/all");
  const Ground in_memory(points, around);
  EXPECT_EQ(PagedHeap::bytes_on_disk(), bytes_on_disk);
  PageFile::let_go_of_all();
  EXPECT_EQ(test::triangles_of(on_disk), test::triangles_of(in_memory));
}

TEST(Ground, MayEndWhereItsPointsEnd) {
  const Ground ground({{20, 20, 5}, {60, 20, 5}, {60, 60, 5}, {20, 60, 5}}, around, GroundExtent::points);
  EXPECT_EQ(covered_area(ground), 1600.0);
  EXPECT_EQ(ground.height_at({95, 95}), 5.0);
}

TEST(Ground, WithoutPointsIsFlatAtZero) { EXPECT_EQ(Ground({}, around).height_at({33, 44}), 0.0); }

constexpr double slope = 0.1, height_at_origin_m = 100.0;
double slope_m(double x_city) { return height_at_origin_m + slope * x_city; }

/// A flat roof 9 m above a ground that the file does not know, from 40 to 60 m.
LocatedCity house_on_ground() {
  LocatedCity located;
  located.city.begin_building("house", HeightReference::on_ground);
  located.city.begin_facet(SurfaceKind::roof, 0);
  located.city.add_ring(std::vector<Point3d>{{40, 40, 9}, {60, 40, 9}, {60, 60, 9}, {40, 60, 9}});
  return located;
}

/// Corners of the triangles of a plane that rises to the east, every 20 m, each corner once for each of its triangles.
std::vector<Point3d> plane(double from_m, double to_m) {
  constexpr double step_m = 20.0;
  std::vector<Point3d> corners;
  for (double x = from_m; x < to_m; x += step_m)
    for (double y = from_m; y < to_m; y += step_m)
      for (const Point2d p :
           {Point2d{x, y}, {x + step_m, y}, {x, y + step_m}, {x + step_m, y}, {x + step_m, y + step_m}, {x, y + step_m}})
        corners.push_back({p.x, p.y, slope_m(p.x)});
  return corners;
}

TileSet tiles_on(std::vector<Point3d> relief, const std::optional<TerrainRaster>& terrain = {}) {
  LocatedCity located = house_on_ground();
  const Grid grid = scenes::grid_covering(located.city, Angle::degrees(20.0), 25.0, 3);
  located.relief_points = std::move(relief);
  Report report;
  return cut_into_tiles(std::move(located), grid, Assign::clip, terrain, report);
}

/// Heights of all vertices of one surface: the lowest and the highest.
std::pair<double, double> heights_of(const TileSet& tiles, std::uint32_t surface) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Tile& tile : tiles.tiles)
    for (std::size_t n = 0; n < tile.triangles.size(); ++n) {
      if (tile.triangle_surfaces[n] != surface) continue;
      for (const std::uint32_t v : {tile.triangles[n].a, tile.triangles[n].b, tile.triangles[n].c}) {
        const double z = static_cast<double>(tile.vertices[v].z) + tiles.height_origin_m;
        range = {std::min(range.first, z), std::max(range.second, z)};
      }
    }
  return range;
}

/// Heights of some ten metres above a tile's zero, as float.
constexpr double ground_rounding_m = 64.0 * static_cast<double>(std::numeric_limits<float>::epsilon());

TEST(Relief, IsTheGround) {
  const TileSet tiles = tiles_on(plane(-200, 300));
  const auto [lowest, highest] = heights_of(tiles, 0);
  // Within the grid, which reaches no farther than its cells of 25 m, turned, do beyond the house
  EXPECT_GT(lowest, slope_m(40.0 - 2 * 25.0 * 1.5));
  EXPECT_LT(highest, slope_m(60.0 + 2 * 25.0 * 1.5));
  EXPECT_GT(highest - lowest, slope * 20.0);
}

TEST(Relief, CarriesBuildingsThatKnowOnlyTheirHeight) {
  const TileSet tiles = tiles_on(plane(-200, 300));
  const auto [lowest, highest] = heights_of(tiles, 1);
  EXPECT_NEAR(lowest, slope_m(40.0) + 9.0, ground_rounding_m);  // the lowest ground under it
  EXPECT_NEAR(highest, slope_m(40.0) + 9.0, ground_rounding_m);
}

void expect_same_ground(const TileSet& found, const TileSet& expected, double tolerance_m) {
  ASSERT_EQ(found.tiles.size(), expected.tiles.size());
  for (std::size_t n = 0; n < found.tiles.size(); ++n)
    EXPECT_NEAR(found.height_origin_m + found.tiles[n].ground_at_centre_m,
                expected.height_origin_m + expected.tiles[n].ground_at_centre_m, tolerance_m)
        << n;
}

TEST(Relief, GivesTheSameGroundAsARasterOfTheSamePlane) {
  TerrainRaster raster{{-200, -200}, {20, 20}, 26, 26, {}};
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column)
      raster.height_m.emplace_back(static_cast<float>(slope_m(raster.node(column, row).x)));
  expect_same_ground(tiles_on(plane(-200, 300)), tiles_on({}, raster), ground_rounding_m);
}

/// A city's grid lies within a single triangle.
TEST(Relief, MayBeAsCoarseAsTheCityIsSmall) {
  std::vector<Point3d> corners;
  for (const Point2d p : {Point2d{-20'000, -20'000}, {20'000, -20'000}, {20'000, 20'000}, {-20'000, 20'000}})
    corners.push_back({p.x, p.y, slope_m(p.x)});
  // Its lowest corner, 1,900 m below 0, is the zero of all heights
  expect_same_ground(tiles_on(corners), tiles_on(plane(-200, 300)),
                     4096.0 * static_cast<double>(std::numeric_limits<float>::epsilon()));
}

TEST(ThinnedRelief, KeepsAllThatIsNearAndALittleOfWhatIsFar) {
  std::vector<Point3d> points;
  for (int i = -200; i < 200; ++i)
    for (int j = -200; j < 200; ++j) points.push_back({10.0 * i, 10.0 * j, 1.0});
  const Box2d rectangle{{-50, -50}, {50, 50}};
  const std::vector<Point3d> thinned = thinned_relief(points, rectangle);
  const auto is_near = [](const Point3d& p) { return std::abs(p.x) <= 150 && std::abs(p.y) <= 150; };
  EXPECT_EQ(std::count_if(thinned.begin(), thinned.end(), is_near), 31 * 31);
  // At distances from 100 m to 200, 400, 800, 1,600 and 1,950 m: squares of 25 m in 500 m by 500 m, then of 50 m in 900 m by 900
  // m ...
  EXPECT_LT(thinned.size(), 31U * 31U + 4U * 22U * 22U + 41U * 41U);
  EXPECT_GT(thinned.size(), 31U * 31U + 400U);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(thinned_relief(points, rectangle), thinned);
}

/// A city of posts: a wall from x = 10 to 20 between two heights.
struct Posts {
  LocatedCity located;
  Report report;

  Posts() {
    located.georeference.origin_m = {1000.0, 2000.0};
    located.sources = {"town.geojson"};
  }
  void add(const std::string& id, HeightReference height_reference, double base_m, double top_m) {
    located.city.begin_building(id, height_reference);
    located.city.begin_facet(SurfaceKind::wall, 0);
    located.city.add_ring(std::vector<Point3d>{{10, 0, base_m}, {20, 0, base_m}, {20, 0, top_m}, {10, 0, top_m}});
  }
  /// The ground rises by 1 m in 10 m to the east.
  void lift(double ground_at_zero_m) {
    lift_onto_terrain(
        located, [=](Point2d p) { return std::optional(ground_at_zero_m + p.x / 10.0); }, report);
  }
  [[nodiscard]] std::pair<double, double> base_and_top_m(std::size_t n) const {
    const auto points = located.city.points_of(located.city.buildings()[n]);
    return {points[0].z, points[2].z};
  }
};

using Heights = std::pair<double, double>;

TEST(LiftOntoTerrain, MovesEachBuildingAsItsHeightsCount) {
  Posts posts;
  posts.add("surveyed", HeightReference::elevation, 50, 60);
  posts.add("house", HeightReference::on_ground, 0, 9);
  posts.add("skyway", HeightReference::on_ground, 4, 9);
  posts.add("hall", HeightReference::down_to_ground, 119, 120);
  posts.lift(100);
  EXPECT_EQ(posts.base_and_top_m(0), Heights(50, 60));
  EXPECT_EQ(posts.base_and_top_m(1), Heights(101, 110));
  EXPECT_EQ(posts.base_and_top_m(2), Heights(105, 110));
  EXPECT_EQ(posts.base_and_top_m(3), Heights(101, 120));
  EXPECT_TRUE(posts.report.problems().empty());
}

TEST(LiftOntoTerrain, ReachesDownFromHighRoofsToo) {
  Posts posts;
  posts.add("tower", HeightReference::down_to_ground, 219, 220);
  posts.lift(0);
  EXPECT_EQ(posts.base_and_top_m(0), Heights(1, 220));
}

TEST(LiftOntoTerrain, LeavesOutRoofsThatLieBelowTheGround) {
  Posts posts;
  posts.add("hall", HeightReference::down_to_ground, 119, 120);
  posts.add("cellar", HeightReference::down_to_ground, 89, 90);
  posts.add("house", HeightReference::on_ground, 0, 9);
  posts.lift(100);
  ASSERT_EQ(posts.located.city.buildings().size(), 2U);
  EXPECT_EQ(posts.located.city.buildings()[1].id, "house");
  EXPECT_EQ(posts.base_and_top_m(1), Heights(101, 110));
  EXPECT_EQ(posts.located.city.points().size(), 8U);
  ASSERT_EQ(posts.report.problems().size(), 1U);
  const Problem& problem = posts.report.problems()[0];
  EXPECT_EQ(problem.code, ProblemCode::height_not_positive);
  EXPECT_EQ(problem.place, "cellar");
  EXPECT_EQ(problem.source, "town.geojson");
  EXPECT_EQ(problem.position, (Point3d{1010, 2000, 89}));
  EXPECT_EQ(problem.detail, "its roof is at 90 m, the ground there at 101 m");
}

TEST(LiftOntoTerrain, LeavesOutRoofsHigherThanAnyBuilding) {
  Posts posts;
  posts.add("kite", HeightReference::down_to_ground, 0, 1.0 + highest_building_m);
  posts.add("record", HeightReference::down_to_ground, 0, 2.0 + highest_building_m);
  posts.lift(1.0 - 10.0 / 10.0);  // the ground at x = 10 is at 1 m
  ASSERT_EQ(posts.located.city.buildings().size(), 1U);
  EXPECT_EQ(posts.located.city.buildings()[0].id, "kite");
  EXPECT_EQ(posts.report.count(ProblemCode::absurd_height), 1U);
}

TEST(LiftOntoTerrain, KnowsNoFootWhereTheGroundIsUnknown) {
  Posts posts;
  posts.add("house", HeightReference::on_ground, 0, 9);
  posts.add("hall", HeightReference::down_to_ground, 119, 120);
  lift_onto_terrain(
      posts.located, [](Point2d) { return std::optional<double>(); }, posts.report);
  ASSERT_EQ(posts.located.city.buildings().size(), 1U);
  EXPECT_EQ(posts.base_and_top_m(0), Heights(0, 9));
  EXPECT_EQ(posts.report.count(ProblemCode::no_height), 1U);
}

bool has_point_at(std::span<const Point3d> points, double height_m) {
  return std::any_of(points.begin(), points.end(), [height_m](const Point3d& p) { return p.z == height_m; });
}

PagedArray<Point3d> base_points(const CityModel& city) { return tiles::base_points(city, bases_of(city)); }

TEST(BasePoints, AreTheLowestOfEachBuilding) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 3.0, 20.0);
  const auto points = base_points(town.city());
  EXPECT_TRUE(has_point_at(points, 3.0));
  EXPECT_FALSE(has_point_at(points, 20.0));
}

TEST(BasePoints, ABridgeBetweenHousesHangs) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{20, 0}, {30, 10}}, 0.0, 20.0);
  town.add_box({{10, 4}, {20, 6}}, 6.0, 9.0);
  EXPECT_FALSE(has_point_at(base_points(town.city()), 6.0));
}

TEST(BasePoints, HousesOnASteepStreetStandOnTheGround) {
  scenes::SceneBuilder town;
  for (int n = 0; n < 6; ++n)
    town.add_box({{20.0 * n, 0}, {20.0 * n + 10, 10}}, 5.0 * n, 5.0 * n + 10);  // 5 m up in 10 m of street
  for (int n = 0; n < 6; ++n) EXPECT_TRUE(has_point_at(base_points(town.city()), 5.0 * n)) << n;
}

TEST(BasePoints, AHouseFarFromAllOthersStandsWhereverItIs) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{10 + base_search_radius_m * 2, 0}, {20 + base_search_radius_m * 2, 10}}, 500.0, 510.0);
  EXPECT_TRUE(has_point_at(base_points(town.city()), 500.0));
}

TEST(BasePoints, TouchingHousesOnAHillStandOnTheGround) {
  constexpr double slope = 0.25, width_m = 10.0;
  for (const double turn : {1.0, -1.0}) {
    scenes::SceneBuilder town;
    for (int n = 0; n < 8; ++n)
      town.add_box({{width_m * n, 0}, {width_m * (n + 1), 12}}, 100 + turn * slope * width_m * n,
                   120 + turn * slope * width_m * n);
    const std::vector<Base> bases = bases_of(town.city());
    EXPECT_EQ(std::count(bases.begin(), bases.end(), Base::on_ground), 8) << turn;
  }
}

TEST(BasePoints, ARoofFarAboveItsOneNeighborHangs) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{10, 0}, {14, 4}}, 15.0, 16.0);
  EXPECT_EQ(bases_of(town.city())[1], Base::above_ground);
}

TEST(BasePoints, AWrongBaseDigsNoPit) {
  scenes::SceneBuilder town;
  for (int n = 0; n < 5; ++n) town.add_box({{12.0 * n, 0}, {12.0 * n + 10, 10}}, n == 2 ? 0.0 : 60.0, 75.0);
  const std::vector<Base> bases = bases_of(town.city());
  for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(bases[n], n == 2 ? Base::below_ground : Base::on_ground) << n;
  EXPECT_FALSE(has_point_at(base_points(town.city()), 0.0));
}

TEST(BasePoints, OneHouseBelowAnotherIsNoError) {
  scenes::SceneBuilder town;
  town.add_box({{0, 0}, {10, 10}}, 0.0, 20.0);
  town.add_box({{12, 0}, {22, 10}}, 60.0, 75.0);
  EXPECT_EQ(bases_of(town.city())[0], Base::on_ground) << "nobody can tell which of two is wrong";
}

/// Rows of houses on a slope of 39°, each too far above the next one for any street.
TEST(BasePoints, MostOfATownAreNeitherBridgesNorErrors) {
  for (const int rows : {4, 3}) {
    scenes::SceneBuilder town;
    for (int n = 0; n < 5 * rows; ++n) {
      const Point2d corner{22.0 * (n % 5), 20.0 * (n / 5)};
      town.add_box({corner, corner + Point2d{10.0, 9.0}}, 0.8 * corner.y, 0.8 * corner.y + 9.0);
    }
    const std::vector<Base> bases = bases_of(town.city());
    const auto on_ground = std::count(bases.begin(), bases.end(), Base::on_ground);
    if (rows == 4)
      EXPECT_EQ(on_ground, 20);
    else
      EXPECT_LT(on_ground, 8) << "fewer than 20 may be bridges above a street";
  }
}

}  // namespace
}  // namespace farlod::tiles
