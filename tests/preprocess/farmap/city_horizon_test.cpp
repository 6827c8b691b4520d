// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farmap/city_horizon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
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

Town small_town(Assign assign = Assign::clip, bool overhangs = true) {
  CitySettings settings;
  settings.size_m = 300;
  settings.lod = 2;
  settings.overhangs = overhangs;
  const CityModel city = scenes::generated_town(settings);
  Report ignored;
  const Grid grid = scenes::grid_covering(city, Angle::degrees(17), 40, 3);
  return {grid, tiles::cut_into_tiles({city, {}}, grid, assign, {}, ignored)};
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
        for (const OccluderEdge& o : city.occluders().subspan(leaf.first_occluder, leaf.occluder_count)) {
          ASSERT_LE(o.z_high_m(), node.z_high_m);
          if (!o.is_upper()) {
            ASSERT_LE(o.z_high_m(), node.z_underside_m);
          }
          for (const Point3d& p : {o.a, o.b}) ASSERT_TRUE(node.outline.contains(horizontal(p)));
        }
      });
    }
  }
}

TEST(CityHorizon, EveryOccluderIsInExactlyOneLeaf) {
  const Town town = small_town();
  const CityHorizon city(town.tiles, town.grid);
  std::vector<int> times(city.occluders().size(), 0);
  std::set<Cell> cells;
  for_each_leaf(city, 0, [&](const CityHorizon::Node& leaf) {
    EXPECT_TRUE(cells.insert(leaf.cell).second);
    for (std::uint32_t o = 0; o < leaf.occluder_count; ++o) ++times[leaf.first_occluder + o];
  });
  EXPECT_EQ(cells.size(), static_cast<std::size_t>(town.grid.cells.size()));
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ssize(times));
}

TEST(CityHorizon, ObstaclesAreTheEdgesOfAllRoles) {
  const Town town = small_town();
  const CityHorizon city(town.tiles, town.grid);
  std::array<int, edge_role_count> of_role{};
  for_each_leaf(city, 0, [&](const CityHorizon::Node& leaf) {
    const Tile& tile = town.tiles.tile(leaf.cell);
    ASSERT_EQ(leaf.occluder_count, tile.horizon_edges.size());
    // An edge belongs to the cell of its middle
    const Point2d corner = city.corner_of(leaf.cell);
    const Box2d square{corner, corner + Point2d{town.grid.cell_edge_m, town.grid.cell_edge_m}};
    for (std::size_t n = 0; n < tile.horizon_edges.size(); ++n) {
      const OccluderEdge& o = city.occluders()[leaf.first_occluder + n];
      const HorizonEdge& e = tile.horizon_edges[n];
      EXPECT_TRUE(square.contains(0.5 * (horizontal(o.a) + horizontal(o.b))));
      const OccluderEdge placed = o.from(corner);
      // Corners of cells are whole multiples of 40 m: moving there and back rounds nothing
      EXPECT_EQ(placed.a, (Point3d{e.a.x, e.a.y, e.a.z}));
      EXPECT_EQ(placed.b, (Point3d{e.b.x, e.b.y, e.b.z}));
      EXPECT_EQ(o.adjacent, e.adjacent);
      EXPECT_EQ(o.role, e.role);
      ++of_role.at(static_cast<std::size_t>(e.role));
    }
  });
  for (const int count : of_role) EXPECT_GT(count, 20) << "the town tests nothing";
}

TEST(CityHorizon, WhereNothingOverhangsNoUndersideIsHigh) {
  const Town town = small_town(Assign::clip, false);
  const CityHorizon city(town.tiles, town.grid);
  for (const CityHorizon::Node& node : city.nodes()) EXPECT_EQ(node.z_underside_m, -std::numeric_limits<double>::infinity());
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
