// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/tile_spool.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/runtime/results/raster/whole_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::NanSensitiveFloatEq;
using testing::Pointwise;

/// Two tiles by two, of which the last are cut; each pixel another value.
WholeRaster raster_of_four_tiles() {
  WholeRaster raster;
  raster.columns = raster_tile_edge + 3;
  raster.rows = raster_tile_edge + 2;
  for (std::size_t n = 0; n < raster.columns * raster.rows; ++n) raster.svf.push_back(static_cast<float>(n));
  return raster;
}

std::vector<float> all_pixels(TileSpool& spool) {
  std::vector<float> pixels = spool.pixels_of_tile_row(0);
  for (const float svf : spool.pixels_of_tile_row(1)) pixels.push_back(svf);
  return pixels;
}

TEST(TileSpool, GivesBackWholeRowsInWhateverOrderTilesCome) {
  const scenes::TemporaryFolder folder;
  const WholeRaster raster = raster_of_four_tiles();
  TileSpool spool(raster, folder.file("a.asc"));
  for (const TilePlace place : {TilePlace{1, 0}, {0, 1}, {1, 1}, {0, 0}}) spool.add(tile_of(raster, place));
  EXPECT_EQ(all_pixels(spool), raster.svf);
}

TEST(TileSpool, TilesThatDoNotComeHaveNoData) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = raster_of_four_tiles();
  TileSpool spool(raster, folder.file("a.asc"));
  for (const TilePlace place : {TilePlace{0, 0}, {1, 1}}) spool.add(tile_of(raster, place));
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column)
      if ((row < raster_tile_edge) != (column < raster_tile_edge)) raster.svf[row * raster.columns + column] = std::nanf("");
  EXPECT_THAT(all_pixels(spool), Pointwise(NanSensitiveFloatEq(), raster.svf));
}

}  // namespace
}  // namespace farlod
