// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "benchmark/contest.hpp"
#include "benchmark/whole_city_rival.hpp"

namespace farlod::benchmark {
namespace {

TEST(Median, IsTheMiddleValue) {
  EXPECT_EQ(median({3.0}), 3.0);
  EXPECT_EQ(median({9.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({9.0, 1.0, 2.0, 4.0}), 3.0);
}

TEST(Duel, MeasuresInTurn) {
  std::string order;
  static_cast<void>(duel(
      3, [&] { order += 'A'; }, [&] { order += 'B'; }));
  EXPECT_EQ(order, "ABABAB");
}

TEST(ErrorLadder, FindsTheLowestRungThatIsGoodEnough) {
  const std::array<float, 2> truth{0.5F, 1.0F};
  const std::array<std::size_t, 4> ladder{4, 8, 16, 32};
  const Answer answer = [](std::size_t samples) { return std::vector<float>{0.5F, 1.0F - 0.25F / static_cast<float>(samples)}; };
  const std::vector<Rung> rungs = climb(ladder, answer, truth);
  ASSERT_EQ(rungs.size(), 4U);
  EXPECT_FLOAT_EQ(static_cast<float>(rungs[0].errors.max_abs), 0.0625F);
  EXPECT_FLOAT_EQ(static_cast<float>(rungs[0].errors.mean_abs), 0.03125F);
  ASSERT_TRUE(rung_within(rungs, 0.02).has_value());
  EXPECT_EQ(rung_within(rungs, 0.02)->samples, 16U);
  EXPECT_FALSE(rung_within(rungs, 0.001).has_value());
}

TEST(BreakEven, CountsPackingAgainstIndexing) {
  SizeRow row;
  row.receivers = 1000;
  row.pack_s = 10.0;
  row.open_s = 1.0;
  row.build_s = 3.0;
  row.rival_s = 0.003;
  row.ours_s = 0.001;
  EXPECT_NEAR(*row.break_even(), 8.0 / 2e-6, 1.0);
  row.ours_s = 0.004;
  EXPECT_FALSE(row.break_even().has_value());
}

TEST(PlaneCurve, WalksFromSquareToNeighboringSquare) {
  constexpr int edge = 8;
  std::array<std::pair<int, int>, edge * edge> walk;
  for (int column = 0; column < edge; ++column)
    for (int row = 0; row < edge; ++row)
      walk.at(static_cast<std::size_t>(place_on_curve((column + 0.5) / edge, (row + 0.5) / edge) >> 26)) = {column, row};
  for (std::size_t n = 1; n < walk.size(); ++n)
    EXPECT_EQ(std::abs(walk[n].first - walk[n - 1].first) + std::abs(walk[n].second - walk[n - 1].second), 1);
}

}  // namespace
}  // namespace farlod::benchmark
