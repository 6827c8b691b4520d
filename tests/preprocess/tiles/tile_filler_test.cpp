// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile_filler.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/determinism/threads.hpp"

namespace farlod::tiles {
namespace {

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
