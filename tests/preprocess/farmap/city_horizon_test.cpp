// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farmap/city_horizon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <tuple>
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
    cells.insert(leaf.cell);
    EXPECT_LE(leaf.occluder_count, 32U);
    for (std::uint32_t o = 0; o < leaf.occluder_count; ++o) ++times[leaf.first_occluder + o];
  });
  EXPECT_EQ(cells.size(), static_cast<std::size_t>(town.grid.cells.size()));
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ssize(times));
}

TEST(CityHorizon, OccludersAreTheEdgesOfAllRoles) {
  const Town town = small_town();
  const CityHorizon city(town.tiles, town.grid);
  std::map<Cell, std::vector<OccluderEdge>> of_cell;
  std::size_t leaves = 0;
  for_each_leaf(city, 0, [&](const CityHorizon::Node& leaf) {
    ++leaves;
    for (const OccluderEdge& o : city.occluders().subspan(leaf.first_occluder, leaf.occluder_count))
      of_cell[leaf.cell].push_back(o.from(city.corner_of(leaf.cell)));
  });
  EXPECT_GT(leaves, of_cell.size() + 20) << "the town divides no cell";
  std::array<int, edge_role_count> of_role{};
  for (auto& [cell, occluders] : of_cell) {
    std::vector<OccluderEdge> edges;
    // Corners of cells are whole multiples of 40 m: moving there and back rounds nothing
    for (const HorizonEdge& e : town.tiles.tile(cell).horizon_edges) {
      edges.push_back({{e.a.x, e.a.y, e.a.z}, {e.b.x, e.b.y, e.b.z}, e.adjacent, e.role});
      ++of_role.at(static_cast<std::size_t>(e.role));
    }
    const auto key = [](const OccluderEdge& o) {
      return std::tuple(o.a.x, o.a.y, o.a.z, o.b.x, o.b.y, o.b.z, o.adjacent.left, o.adjacent.right, o.role);
    };
    std::ranges::sort(edges, {}, key);
    std::ranges::sort(occluders, {}, key);
    EXPECT_TRUE(std::ranges::equal(edges, occluders, {}, key, key));
    // An edge belongs to the cell of its middle
    const Box2d square{{0.0, 0.0}, {town.grid.cell_edge_m, town.grid.cell_edge_m}};
    for (const OccluderEdge& o : occluders) EXPECT_TRUE(square.contains(0.5 * (horizontal(o.a) + horizontal(o.b))));
  }
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
