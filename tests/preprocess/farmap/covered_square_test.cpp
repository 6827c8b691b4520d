// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "farmap/horizon_map_baker.hpp"
#include "tests/preprocess/farmap/far_city.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

/// A canopy, 1200 m wide and 6 m up; whole, it belongs to one cell, far from most that it hangs over.
TileSet canopy(const Grid& grid, const CityModel& city) {
  Report ignored;
  return cut_into_tiles({city, {}}, grid, Assign::whole, {}, ignored);
}

TEST(CoveredSquare, WhatHangsOverAllOfASquareIsNamed) {
  // Its edges are so far that they hardly rise above the horizontal; what they bound hangs overhead
  scenes::SceneBuilder scene;
  for (const double x : {-601.0, 597.0}) scene.add_box({{x, x}, {x + 4, x + 4}}, 0.0, 3.0);
  scene.add_polygon({{-600, -600, 6}, {600, -600, 6}, {600, 600, 6}});
  const Grid grid = scenes::grid_covering(scene.city(), {}, 50, 1);
  const TileSet tiles = canopy(grid, scene.city());
  const Cell cell{4, -5};  // as far from all three edges as can be
  const Block block = grid.block_of(cell);
  const BakedHorizons maps = HorizonMapBaker(tiles, grid, {}).bake(block);
  const BakedHorizon& map = maps.cells.at(grid.cells_of(block).index_of(cell));
  for (std::uint32_t square = 0; square < map.patches.squares(); ++square)
    EXPECT_FALSE(test::named_in(maps, map, map.patches.number(square, 0)).empty()) << "square " << square;
}

}  // namespace
}  // namespace farlod
