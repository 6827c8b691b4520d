// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/side_edges.hpp"

#include <gmock/gmock.h>

#include <array>

#include "package/block_tiles.hpp"
#include "package/tiles_writer.hpp"
#include "tests/scenes/edges_as_set.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

using package::TileEdge;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr AdjacentSlopes passing{0, 0};

/// A fan of triangles around its first corner, in the plane.
class FanOfTriangles : public testing::Test {
 protected:
  explicit FanOfTriangles(std::uint32_t count = 2) {
    for (std::uint32_t n = 0; n < count + 2; ++n)
      (void)vertices_.number_of({static_cast<float>(n), static_cast<float>(n % 7), 0});
    for (std::uint32_t n = 0; n < count; ++n) triangles_.push_back({0, n + 1, n + 2});
  }
  [[nodiscard]] HorizonEdge edge(std::uint32_t from, std::uint32_t to, AdjacentSlopes adjacent) const {
    return {vertices_.vertices()[from], vertices_.vertices()[to], adjacent};
  }
  [[nodiscard]] SideEdges written(const std::vector<HorizonEdge>& edges) const {
    return side_edges(edges, triangles_, vertices_);
  }

  SharedVertices vertices_;
  std::vector<Triangle> triangles_;
};

TEST_F(FanOfTriangles, EachSideCanBeAnEdge) {
  const std::array<std::array<std::uint32_t, 2>, 5> sides{{{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 0}}};
  const std::array<std::uint8_t, 5> passed{0, 1, 2, 4, 5};
  for (std::size_t n = 0; n < sides.size(); ++n) {
    const auto [sides_found, loose] = written({edge(sides[n][0], sides[n][1], {-7, 9})});
    EXPECT_THAT(sides_found, ElementsAre(TileEdge{passed[n], {-7, 9}})) << n;
    EXPECT_THAT(loose, IsEmpty());
  }
}

TEST_F(FanOfTriangles, AnEdgeAgainstItsSideIsTurned) {
  EXPECT_THAT(written({edge(3, 2, {-7, 9})}).sides, ElementsAre(TileEdge{4, {9, -7}}));
}

TEST_F(FanOfTriangles, EdgesFollowTheSides) {
  EXPECT_THAT(written({edge(3, 0, {5, 5}), edge(0, 1, {1, 1}), edge(1, 2, {2, 2})}).sides,
              ElementsAre(TileEdge{0, {1, 1}}, TileEdge{0, {2, 2}}, TileEdge{3, {5, 5}}));
}

TEST_F(FanOfTriangles, EqualEdgesAreDifferentSidesWhileThereAreAny) {
  // Two triangles have it, one the other way round; the third time nobody does
  const auto [sides, loose] = written({edge(0, 2, {1, 2}), edge(0, 2, {3, 4}), edge(0, 2, {5, 6})});
  EXPECT_THAT(sides, ElementsAre(TileEdge{2, {2, 1}}, TileEdge{0, {3, 4}}));
  EXPECT_THAT(loose, ElementsAre(edge(0, 2, {5, 6})));
}

TEST_F(FanOfTriangles, WhatIsNoSideIsLoose) {
  const HorizonEdge between_corners = edge(1, 3, {1, 2});
  const HorizonEdge beside{vertices_.vertices()[0], {0.5F, 0, 0}, {3, 4}};
  const auto [sides, loose] = written({beside, edge(1, 2, {5, 6}), between_corners});
  EXPECT_THAT(sides, ElementsAre(TileEdge{1, {5, 6}}));
  EXPECT_THAT(loose, ElementsAre(beside, between_corners));
}

class LargeFan : public FanOfTriangles {
 protected:
  LargeFan() : FanOfTriangles(500) {}
};

TEST_F(LargeFan, RowsPassAsManySidesAsTheyCan) {
  const auto rims = [&](std::uint32_t triangle) { return edge(triangle + 1, triangle + 2, {1, 2}); };
  // The rim of triangle t is side 3t + 1
  EXPECT_THAT(written({rims(84)}).sides, ElementsAre(TileEdge{253, {1, 2}}));
  EXPECT_THAT(written({edge(0, 86, {1, 2})}).sides, ElementsAre(TileEdge{254, {2, 1}}));
  EXPECT_THAT(written({rims(85)}).sides, ElementsAre(TileEdge{255, passing}, TileEdge{1, {1, 2}}));
  EXPECT_THAT(written({rims(0), edge(87, 0, {3, 4})}).sides,
              ElementsAre(TileEdge{1, {1, 2}}, TileEdge{255, passing}, TileEdge{0, {3, 4}}));
  EXPECT_THAT(written({edge(501, 0, {1, 2})}).sides,
              ElementsAre(TileEdge{255, passing}, TileEdge{255, passing}, TileEdge{255, passing}, TileEdge{255, passing},
                          TileEdge{255, passing}, TileEdge{224, {1, 2}}));
}

class EdgesOfATown : public testing::TestWithParam<Assign> {};

TEST_P(EdgesOfATown, ComeBackAsTheSameSet) {
  CitySettings settings;
  settings.lod = 2;
  settings.overhangs = true;
  settings.terrain_relief_m = 20.0;
  const CityModel city = scenes::generated_town(settings);
  const Grid grid = scenes::grid_covering(city, Angle::degrees(17.0), 50.0, 3);
  Report ignored;
  const TileSet tiles = tiles::cut_into_tiles({city, {}}, grid, GetParam(), {}, ignored);
  std::size_t sides = 0, loose = 0;
  for (const Block block : grid.blocks()) {
    const CellRange cells = grid.cells_of(block);
    const std::vector<std::byte> file =
        farlod::tiles_file(tiles, BakedBoxes(static_cast<std::size_t>(cells.size())), grid, block);
    const BlockTiles written(file, cells, "tiles.bin");
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
      const TileView view = written.tile(cells.cell_at(n));
      std::vector<HorizonEdge> read;
      view.visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
      ASSERT_EQ(scenes::edges_as_set(read), scenes::edges_as_set(tiles.tile(cells.cell_at(n)).horizon_edges)) << n;
      sides += read.size() - view.loose_edges.size();
      loose += view.loose_edges.size();
    }
  }
  EXPECT_GT(sides, 10'000U) << "the scene tests nothing";
  EXPECT_LT(loose, sides / 50) << "naming edges as sides saves nothing";
}

INSTANTIATE_TEST_SUITE_P(All, EdgesOfATown, testing::Values(Assign::clip, Assign::whole),
                         [](const auto& test) { return test.param == Assign::clip ? "Clip" : "Whole"; });

}  // namespace
}  // namespace farlod
