// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/scenes/packed_city.hpp"
#include "tiles/relief_thinning.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles {
namespace {

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

}  // namespace
}  // namespace farlod::tiles
