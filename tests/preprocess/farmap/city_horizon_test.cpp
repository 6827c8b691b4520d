// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farmap/city_horizon.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

struct Town {
  Grid grid;
  TileSet tiles;
};

Town small_town(Assign assign = Assign::clip) {
  CitySettings settings;
  settings.size_m = 300;
  settings.lod = 2;
  settings.overhangs = true;
  const CityModel city = scenes::generated_town(settings);
  Report ignored;
  const Grid grid = scenes::grid_covering(city, Angle::degrees(17), 40, 3);
  return {grid, cut_into_tiles({city, {}}, grid, assign, {}, ignored)};
}

/// Calls `visit` for each leaf below a node, itself perhaps.
template <class Visit>
void for_each_leaf(const CityHorizon& city, std::uint32_t n, const Visit& visit) {
  const CityHorizon::Node& node = city.nodes()[n];
  if (node.children == 0) return visit(node);
  for_each_leaf(city, node.children, visit);
  for_each_leaf(city, node.children + 1, visit);
}

TEST(CityHorizon, NodesContainWhatIsBelowThem) {
  for (const Assign assign : {Assign::clip, Assign::whole}) {
    const Town town = small_town(assign);
    const CityHorizon city(town.tiles, town.grid);
    for (std::uint32_t n = 0; n < city.nodes().size(); ++n) {
      const CityHorizon::Node& node = city.nodes()[n];
      for_each_leaf(city, n, [&](const CityHorizon::Node& leaf) {
        for (const Obstacle& o : city.obstacles().subspan(leaf.first_obstacle, leaf.obstacle_count)) {
          ASSERT_LE(o.z_high_m(), node.z_high_m);
          for (const Point3d& p : o.corners) ASSERT_TRUE(node.outline.contains(horizontal(p)));
        }
      });
    }
  }
}

TEST(CityHorizon, EveryObstacleIsInExactlyOneLeaf) {
  const Town town = small_town();
  const CityHorizon city(town.tiles, town.grid);
  std::vector<int> times(city.obstacles().size(), 0);
  std::set<Cell> cells;
  for_each_leaf(city, 0, [&](const CityHorizon::Node& leaf) {
    EXPECT_TRUE(cells.insert(leaf.cell).second);
    for (std::uint32_t o = 0; o < leaf.obstacle_count; ++o) ++times[leaf.first_obstacle + o];
  });
  EXPECT_EQ(cells.size(), static_cast<std::size_t>(town.grid.cells.size()));
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ssize(times));
}

TEST(CityHorizon, ObstaclesAreTheHorizonEdgesAndTheTrianglesOfWhatDoesNotStand) {
  const Town town = small_town();
  const CityHorizon city(town.tiles, town.grid);
  for_each_leaf(city, 0, [&](const CityHorizon::Node& leaf) {
    const Tile& tile = town.tiles.tile(leaf.cell);
    const auto hanging = std::count_if(tile.triangle_surfaces.begin(), tile.triangle_surfaces.end(),
                                       [&](std::uint32_t s) { return !town.tiles.surfaces[s].stands; });
    EXPECT_EQ(leaf.obstacle_count, tile.horizon_edges.size() + static_cast<std::size_t>(hanging));
    // Triangles are cut exactly; an edge belongs to the cell of its middle
    const Point2d corner = city.corner_of(leaf.cell);
    const Box2d square{corner, corner + Point2d{town.grid.cell_edge_m, town.grid.cell_edge_m}};
    for (const Obstacle& o : city.obstacles().subspan(leaf.first_obstacle, leaf.obstacle_count)) {
      EXPECT_TRUE(square.contains(0.5 * (horizontal(o.corners[0]) + horizontal(o.corners[1]))));
      for (const Point3d& p : o.corners) EXPECT_TRUE(o.is_edge || square.contains(horizontal(p)));
    }
  });
  EXPECT_TRUE(std::any_of(city.obstacles().begin(), city.obstacles().end(), [](const Obstacle& o) { return !o.is_edge; }));
}

TEST(CityHorizon, WithoutObstaclesThereIsNoTree) {
  Grid grid;
  grid.cells = {0, 0, 2, 2};
  TileSet tiles;
  tiles.cells = grid.cells;
  tiles.tiles.resize(4);
  EXPECT_TRUE(CityHorizon(tiles, grid).nodes().empty());
}

}  // namespace
}  // namespace farlod
