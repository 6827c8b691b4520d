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
#include <utility>
#include <vector>

#include "farmap/occlusion_culler.hpp"
#include "tests/preprocess/farmap/sight.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

using test::Chance;

struct Town {
  Grid grid;
  TileSet tiles;
};

Town small_town(Assign assign = Assign::clip, bool overhangs = true) {
  CitySettings settings{.size_m = 300, .lod = 2, .overhangs = overhangs};
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

constexpr double cell_edge_m = 50.0;
const AzimuthBins bins{128};
const BinBorders borders(bins);

ReceiverPatches patches() { return {cell_edge_m, 2, {0.0F, 3.0F, 10.0F, 40.0F}}; }

std::vector<std::pair<Point3d, Point3d>> random_edges(std::size_t count, Chance& chance) {
  std::vector<std::pair<Point3d, Point3d>> edges;
  while (edges.size() < count) {
    const Point3d a{chance.between(-300, 300), chance.between(-300, 300), chance.between(0, 60)};
    const Point3d b = a + Point3d{chance.between(-40, 40), chance.between(-40, 40), chance.between(-5, 5)};
    const bool outside = std::max(std::abs(a.x - 25), std::abs(a.y - 25)) > 80.0;
    if (outside) edges.emplace_back(a, b);
  }
  return edges;
}

/// The steepest of all edges along the middle of a bin; 0 where nothing rises.
double horizon(const std::vector<std::pair<Point3d, Point3d>>& edges, const Point3d& eye, std::uint32_t bin) {
  double steepest = 0.0;
  for (const auto& [a, b] : edges)
    steepest = std::max(steepest, test::slope_at((bin + 0.5) * bins.width_rad(), a, b, eye).value_or(0.0));
  return steepest;
}

/// A slope is computed in double, as a difference of two numbers of which neither is above 1e6 here, and stored as a float.
double slope_rounding(double slope) { return std::numeric_limits<float>::epsilon() * slope + 1e6 * 1e-15; }

TEST(ViewpointHorizons, AreTheSteepestEdgesAlongTheMiddlesOfTheBins) {
  Chance chance(3);
  const auto edges = random_edges(60, chance);
  ViewpointHorizons views(cell_edge_m, patches(), borders);
  for (const auto& [a, b] : edges) views.add(a, b);
  for (std::uint32_t level = 0; level < 4; ++level)
    for (std::uint32_t corner = 0; corner < 9; ++corner) {
      const Point3d eye{corner % 3 * 25.0, corner / 3 * 25.0, patches().levels_m()[level]};
      for (std::uint32_t bin = 0; bin < bins.count; ++bin) {
        const double expected = horizon(edges, eye, bin);
        ASSERT_NEAR(views.slope(corner % 3, corner / 3, level, bin), expected, slope_rounding(expected))
            << "corner " << corner << ", level " << level << ", bin " << bin;
      }
    }
}

TEST(ViewpointHorizons, LowestIsTheLowestOfALevel) {
  Chance chance(4);
  ViewpointHorizons views(cell_edge_m, patches(), borders);
  for (const auto& [a, b] : random_edges(200, chance)) views.add(a, b);
  for (std::uint32_t level = 0; level < 4; ++level) {
    for (std::uint32_t bin = 0; bin < bins.count; ++bin) {
      float expected = std::numeric_limits<float>::infinity();
      for (std::uint32_t corner = 0; corner < 9; ++corner)
        expected = std::min(expected, views.slope(corner % 3, corner / 3, level, bin));
      ASSERT_EQ(views.lowest(bin)[level], expected);
    }
  }
}

TEST(ViewpointHorizons, AnEdgeInLineWithTheEyeCoversNothing) {
  ViewpointHorizons views(cell_edge_m, ReceiverPatches{cell_edge_m, 1, {0.0F}}, borders);
  views.add({100, 0, 10}, {200, 0, 10});
  float along = 0.0F, beside = 0.0F;
  for (std::uint32_t bin = 0; bin < bins.count; ++bin) {
    along = std::max(along, views.slope(0, 0, 0, bin));
    beside = std::max(beside, views.slope(0, 1, 0, bin));
  }
  EXPECT_EQ(along, 0.0F);
  EXPECT_GT(beside, 0.0F);
}

}  // namespace
}  // namespace farlod
