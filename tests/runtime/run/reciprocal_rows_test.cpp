// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/reciprocal_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace farlod {
namespace {

/// Of floats near 1.
constexpr double share_rounding = 1e-6;

/// Surface 0 has four times the area and the receivers of surface 1; column 2 is the sky, 3 the ground.
TEST(ReciprocalRows, HaveTheMeanOfBothAndTheRestTakesUpTheDifference) {
  const std::array<FoundRow, 2> found{{{40.0, 8, {{1, 0.1F}, {2, 0.6F}, {3, 0.3F}}}, {10.0, 2, {{0, 0.6F}, {2, 0.4F}}}}};
  ReciprocalRows rows(found);
  const std::vector<ViewShare> first = rows.row(0), second = rows.row(1);
  // The exchange is 4 m² for the one and 6 m² for the other, each with a ray to a fifth of a square metre
  ASSERT_EQ(first.size(), 3U);
  EXPECT_NEAR(first[0].share, 5.0 / 40.0, share_rounding);
  EXPECT_NEAR(first[1].share, 0.6 * 0.875 / 0.9, share_rounding);
  EXPECT_NEAR(first[2].share, 0.3 * 0.875 / 0.9, share_rounding);
  ASSERT_EQ(second.size(), 2U);
  EXPECT_NEAR(second[0].share, 5.0 / 10.0, share_rounding);
  EXPECT_NEAR(second[1].share, 0.5, share_rounding);
  const MatrixFigures figures = rows.figures();
  EXPECT_EQ(figures.receivers, 10U);
  EXPECT_NEAR(figures.reciprocity_max, 2.0 / 40.0, share_rounding);
  EXPECT_NEAR(figures.reciprocity_mean, 2.0 / 40.0, share_rounding);
  EXPECT_NEAR(figures.closure_max, 0.1, share_rounding);
  EXPECT_NEAR(figures.closure_mean, 0.0625, share_rounding);
  EXPECT_EQ(figures.divided_rows, 0U);
}

TEST(ReciprocalRows, WhatHasMoreRaysToItsAreaCountsMore) {
  const std::array<FoundRow, 2> found{{{10.0, 30, {{1, 0.2F}, {2, 0.8F}}}, {10.0, 10, {{0, 0.6F}, {2, 0.4F}}}}};
  ReciprocalRows rows(found);
  EXPECT_NEAR(rows.row(0).front().share, 0.3, share_rounding);
  EXPECT_NEAR(rows.row(1).front().share, 0.3, share_rounding);
}

TEST(ReciprocalRows, WhatOneOfTwoDidNotMeetIsHalfOfWhatTheOtherMet) {
  const std::array<FoundRow, 2> found{{{10.0, 5, {{2, 1.0F}}}, {10.0, 5, {{0, 0.02F}, {2, 0.98F}}}}};
  ReciprocalRows rows(found);
  const std::vector<ViewShare> first = rows.row(0);
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first.front().column, 1U);
  EXPECT_NEAR(first.front().share, 0.01, share_rounding);
  EXPECT_NEAR(first.back().share, 0.99, share_rounding);
}

TEST(ReciprocalRows, ASurfaceWithoutReceiversKeepsWhatOthersSeeOfIt) {
  const std::array<FoundRow, 2> found{{{10.0, 5, {{1, 0.25F}, {2, 0.75F}}}, {0.0, 0, {}}}};
  ReciprocalRows rows(found);
  EXPECT_NEAR(rows.row(0).front().share, 0.25, share_rounding);
  EXPECT_TRUE(rows.row(1).empty());
  EXPECT_EQ(rows.figures().closure_max, 0.0);
}

TEST(ReciprocalRows, WhereNothingCanTakeUpTheDifferenceRowsAreDivided) {
  const std::array<FoundRow, 2> found{{{10.0, 5, {{1, 1.0F}}}, {20.0, 10, {{0, 0.9F}, {2, 0.1F}}}}};
  ReciprocalRows rows(found);
  const std::vector<ViewShare> first = rows.row(0);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_NEAR(first.front().share, 1.0, share_rounding);
  (void)rows.row(1);
  EXPECT_EQ(rows.figures().divided_rows, 1U);
}

}  // namespace
}  // namespace farlod
