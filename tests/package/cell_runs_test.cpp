// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/cell_runs.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "package/manifest.hpp"

namespace farlod::package {
namespace {

TEST(CellRuns, OfNeighborsIsOneRun) {
  const std::vector<std::size_t> places{0, 1, 2, 5, 7, 8};
  EXPECT_EQ(CellRuns::of(places), (CellRuns{{{0, 3}, {5, 6}, {7, 9}}}));
  EXPECT_EQ(CellRuns::of({}), CellRuns{});
}

/// A set of numbers says the same.
TEST(CellRuns, SayWhatASetSays) {
  std::mt19937 random(3);
  for (int n = 0; n < 50; ++n) {
    std::set<std::size_t> set;
    for (std::size_t k = random() % 40; k > 0; --k) set.insert(random() % 40);
    const std::vector<std::size_t> places(set.begin(), set.end());
    const CellRuns runs = CellRuns::of(places);
    EXPECT_EQ(runs.size(), set.size());
    EXPECT_EQ(runs.places(), places);
    std::size_t before = 0;
    for (std::size_t place = 0; place < 45; ++place) {
      EXPECT_EQ(runs.contains(place), set.contains(place)) << place;
      EXPECT_EQ(runs.count_before(place), before) << place;
      before += set.contains(place) ? 1 : 0;
    }
  }
}

TEST(CellRuns, TilesOfAPictureAreInOneColumn) {
  const CellRange cells{-1, 2, 2, 4};
  const std::vector<std::size_t> places{1, 3, 5};
  const std::optional<CellRuns> some = CellRuns::of(places);
  EXPECT_EQ(picture_tiles(cells, some).columns, 1);
  EXPECT_EQ(picture_tiles(cells, some).rows, 3);
  for (std::int32_t k = 0; k < 3; ++k) {
    const PictureTile tile = picture_tile(cells.cell_at(places[static_cast<std::size_t>(k)]), cells, some);
    EXPECT_EQ(tile.column, 0);
    EXPECT_EQ(tile.row, k);
  }
  EXPECT_EQ(picture_tiles(cells, std::nullopt).columns, 3);
  EXPECT_EQ(picture_tile({1, 3}, cells, std::nullopt).column, 2);
  EXPECT_EQ(picture_tile({1, 3}, cells, std::nullopt).row, 1);
}

}  // namespace
}  // namespace farlod::package
