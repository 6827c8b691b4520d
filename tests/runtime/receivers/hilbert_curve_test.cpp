// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/hilbert_curve.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;

std::vector<Cell> cells_of(const CellRange& range) {
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) cells.push_back(range.cell_at(n));
  return cells;
}

TEST(HilbertCurve, HasHilbertsOwnPicture) {
  // D. Hilbert, Über die stetige Abbildung einer Linie auf ein Flächenstück (1891), figures 1 and 2
  EXPECT_THAT(along_hilbert_curve(cells_of({0, 0, 2, 2}), 1), ElementsAre(Cell{0, 0}, Cell{0, 1}, Cell{1, 1}, Cell{1, 0}));
  EXPECT_THAT(along_hilbert_curve(cells_of({0, 0, 4, 4}), 1),
              ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{1, 1}, Cell{0, 1}, Cell{0, 2}, Cell{0, 3}, Cell{1, 3}, Cell{1, 2},
                          Cell{2, 2}, Cell{2, 3}, Cell{3, 3}, Cell{3, 2}, Cell{3, 1}, Cell{2, 1}, Cell{2, 0}, Cell{3, 0}));
}

TEST(HilbertCurve, EachCellHasAPlaceOfItsOwn) {
  for (const int order : {0, 1, 3, 6}) {
    const std::int32_t edge = 1 << order;
    std::set<std::uint64_t> places;
    for (const Cell c : cells_of({0, 0, edge, edge})) places.insert(hilbert_index(c, order));
    EXPECT_EQ(places.size(), std::size_t{1} << 2 * order);
    EXPECT_EQ(*places.rbegin(), (std::uint64_t{1} << 2 * order) - 1);
  }
}

TEST(HilbertCurve, CellsThatFollowEachOtherShareAnEdge) {
  const std::vector<Cell> cells = along_hilbert_curve(cells_of({-5, 17, 59, 81}), 1);
  for (std::size_t n = 1; n < cells.size(); ++n)
    ASSERT_EQ(std::abs(cells[n].i - cells[n - 1].i) + std::abs(cells[n].j - cells[n - 1].j), 1) << n;
}

TEST(HilbertCurve, LosesNoCellOfAnyRectangle) {
  for (const CellRange range : {CellRange{0, 0, 1, 1}, {-3, 5, 40, 6}, {-20, -30, 11, 7}}) {
    std::vector<Cell> cells = cells_of(range);
    const std::vector<Cell> ordered = along_hilbert_curve(cells, 8);
    EXPECT_THAT(ordered, UnorderedElementsAreArray(cells));
    std::reverse(cells.begin(), cells.end());
    EXPECT_EQ(along_hilbert_curve(cells, 8), ordered);
  }
  EXPECT_THAT(along_hilbert_curve({}, 8), IsEmpty());
}

TEST(HilbertCurve, FinishesABlockBeforeItLeaves) {
  Grid grid;
  grid.block_edge = 8;
  std::set<Block> left;
  Block here{-1, 0};
  for (const Cell c : along_hilbert_curve(cells_of({-3, 5, 40, 50}), grid.block_edge)) {
    if (grid.block_of(c) == here) continue;
    EXPECT_TRUE(left.insert(here).second) << "came back to block " << here.i << ' ' << here.j;
    here = grid.block_of(c);
  }
  EXPECT_EQ(left.size() + 1, 6U * 7U);
}

TEST(HilbertCurve, ReachesAsFarAsCellsDo) {
  constexpr std::int32_t far = std::numeric_limits<std::int32_t>::max() / 2;
  EXPECT_THAT(along_hilbert_curve({{far, -far}, {-far, -far}}, 32), ElementsAre(Cell{-far, -far}, Cell{far, -far}));
  constexpr std::int32_t last = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(hilbert_index({last, 0}, 31), (std::uint64_t{1} << 62) - 1);
}

}  // namespace
}  // namespace farlod
