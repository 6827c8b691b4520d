// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles {
namespace {

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
  CitySettings settings;
  settings.size_m = 320.0;
  settings.seed = seed;
  settings.lod = lod;
  settings.terrain_relief_m = relief_m;
  return settings;
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
