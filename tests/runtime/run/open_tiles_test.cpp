// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/open_tiles.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "run/memory_limit.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Three tiles by two, of which the last column and row are cut.
RasterPlan plan_of_six() { return {{}, 1.0, 2 * raster_tile_edge + 10, raster_tile_edge + 1}; }

TileRange one_tile(std::size_t row, std::size_t column) { return {{row, column}, {row + 1, column + 1}}; }

/// Remembers the places of the tiles that were handed on.
struct HandedOn {
  std::vector<TilePlace> places;
  std::function<void(const RasterTile&)> remember() {
    return [this](const RasterTile& tile) { places.push_back(tile.place); };
  }
};

TEST(RasterTile, TheLastTilesAreCut) {
  EXPECT_EQ(tiles_along(0), 0U);
  EXPECT_EQ(tiles_along(raster_tile_edge), 1U);
  EXPECT_EQ(tiles_along(raster_tile_edge + 1), 2U);
  EXPECT_EQ(pixels_of_tile(0, raster_tile_edge + 1), raster_tile_edge);
  EXPECT_EQ(pixels_of_tile(1, raster_tile_edge + 1), 1U);
}

TEST(OpenTiles, ATileIsHandedOnWithTheLastPartThatReachesIt) {
  HandedOn handed;
  const std::vector<TileRange> parts{{{0, 0}, {1, 2}}, one_tile(0, 0), one_tile(0, 1)};
  OpenTiles tiles(plan_of_six(), RasterBands::svf, 0, parts, handed.remember());
  tiles.put(3, 3, {0.5F});
  tiles.put(raster_tile_edge, 0, {0.5F});
  tiles.part_done();
  EXPECT_THAT(handed.places, IsEmpty());
  EXPECT_EQ(tiles.count(), 2U);
  tiles.part_done();
  EXPECT_THAT(handed.places, ElementsAre(TilePlace{0, 0}));
  tiles.part_done();
  EXPECT_THAT(handed.places, ElementsAre(TilePlace{0, 0}, TilePlace{0, 1}));
  EXPECT_EQ(tiles.count(), 0U);
}

TEST(OpenTiles, TilesWithoutAnAnswerAreNotHandedOn) {
  HandedOn handed;
  const std::vector<TileRange> parts{{{0, 0}, {2, 3}}};
  OpenTiles tiles(plan_of_six(), RasterBands::svf, 0, parts, handed.remember());
  tiles.put(raster_tile_edge, raster_tile_edge, {0.5F});
  tiles.part_done();
  EXPECT_THAT(handed.places, ElementsAre(TilePlace{1, 1}));
}

TEST(OpenTiles, AnswersStandAtTheirPixels) {
  std::vector<RasterTile> handed;
  const std::vector<TileRange> parts{one_tile(0, 1)};
  OpenTiles tiles(plan_of_six(), RasterBands::svf_and_bounds, 0, parts,
                  [&handed](const RasterTile& tile) { handed.push_back(tile); });
  tiles.put(raster_tile_edge + 7, 2, {0.5F, 0.25F, 0.75F});
  tiles.part_done();
  ASSERT_EQ(handed.size(), 1U);
  const std::size_t pixel = 2 * raster_tile_edge + 7;
  EXPECT_EQ(handed[0].svf[pixel], 0.5F);
  EXPECT_EQ(handed[0].low[pixel], 0.25F);
  EXPECT_EQ(handed[0].high[pixel], 0.75F);
  EXPECT_TRUE(std::isnan(handed[0].svf[pixel + 1]) && std::isnan(handed[0].high[pixel + 1]));
}

TEST(OpenTiles, TellsBeforehandHowManyWillBeOpen) {
  const std::vector<TileRange> together{{{0, 0}, {2, 3}}}, in_turn{one_tile(0, 0), one_tile(0, 1), one_tile(0, 2)},
      held_up{one_tile(0, 0), one_tile(0, 1), one_tile(0, 2), one_tile(0, 0)};
  EXPECT_EQ(OpenTiles::most_open(plan_of_six(), together), 6U);
  EXPECT_EQ(OpenTiles::most_open(plan_of_six(), in_turn), 1U);
  EXPECT_EQ(OpenTiles::most_open(plan_of_six(), held_up), 2U);
  EXPECT_EQ(OpenTiles::most_open(plan_of_six(), {}), 0U);
}

/// Blocks of 1 km, and crowns of a million bytes.
package::Manifest city_of(std::int32_t columns, std::int32_t rows) {
  package::Manifest manifest;
  manifest.grid.cell_edge_m = 100.0;
  manifest.grid.block_edge = 10;
  manifest.grid.cells = {0, 0, columns, rows};
  manifest.canopy.emplace();
  manifest.canopy->stamp.bytes = 1'000'000;
  return manifest;
}

TEST(CrownsAtWork, AreNoneWithoutTrees) {
  package::Manifest manifest = city_of(80, 80);
  manifest.canopy.reset();
  EXPECT_EQ(bytes_of_crowns_at_work(manifest), 0.0);
}

TEST(CrownsAtWork, OfASmallCityAreAll) { EXPECT_EQ(bytes_of_crowns_at_work(city_of(80, 80)), 1e6); }

// Two blocks and 3 km on both sides are 8 km
TEST(CrownsAtWork, OfALargeCityAreThoseAroundFourBlocks) {
  EXPECT_NEAR(bytes_of_crowns_at_work(city_of(320, 320)), 1e6 * 2.0 / 16.0, 1e-6);
  EXPECT_NEAR(bytes_of_crowns_at_work(city_of(320, 20)), 1e6 * 2.0 / 4.0, 1e-6);
}

}  // namespace
}  // namespace farlod
