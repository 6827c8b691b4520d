// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/plan_background.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace farlod {
namespace {

const RasterPlan small_plan{{0.0, 0.0}, 2.0, 8, 6};

/// A plane that rises by so much a metre to the east and to the north.
std::vector<float> plane(double east, double north) {
  std::vector<float> heights;
  for (std::size_t row = 0; row < small_plan.rows; ++row)
    for (std::size_t column = 0; column < small_plan.columns; ++column) {
      const Point2d p = small_plan.centre_m(column, row);
      heights.push_back(static_cast<float>(east * p.x + north * p.y));
    }
  return heights;
}

/// Of a handful of floats near 1.
constexpr float rounding = 1e-5F;

TEST(Shading, LevelGroundHasNone) { EXPECT_TRUE(shading_of(plane(0.0, 0.0), small_plan).empty()); }

TEST(Shading, WhatLooksToTheNorthWestIsLit) {
  // It falls to the north-west, and therefore rises to the east and the south
  for (const float f : shading_of(plane(0.3, -0.3), small_plan)) EXPECT_GT(f, 1.1F);
  for (const float f : shading_of(plane(-0.3, 0.3), small_plan)) EXPECT_LT(f, 0.9F);
}

TEST(Shading, IsWhatLambertsLawSays) {
  const double slope = 0.2;
  const std::vector<float> shading = shading_of(plane(slope, 0.0), small_plan);
  const double up = std::numbers::sqrt2 / 2.0;
  const double light = (0.5 * slope + up) / std::hypot(1.0, slope) / up;
  for (const float f : shading) EXPECT_NEAR(f, light, rounding);
}

TEST(Shading, UnknownGroundIsTakenAsLevel) {
  std::vector<float> heights = plane(0.3, -0.3);
  const std::size_t hole = 3 * small_plan.columns + 4;
  for (const std::size_t n : {hole - 1, hole, hole + 1, hole - small_plan.columns, hole + small_plan.columns})
    heights[n] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> shading = shading_of(heights, small_plan);
  EXPECT_EQ(shading[hole], 1.0F);
  EXPECT_GT(shading[0], 1.1F);
}

TEST(Shading, AWeakSlopeThatNobodySeesIsLeftOut) {
  EXPECT_TRUE(shading_of(plane(0.01, 0.0), small_plan).empty());
  EXPECT_FALSE(shading_of(plane(0.1, 0.0), small_plan).empty());
}

TEST(Shading, OneSteepPixelInThousandsIsNoRelief) {
  const RasterPlan plan{{0.0, 0.0}, 2.0, 100, 100};
  std::vector<float> heights(10'000, 5.0F);
  heights[5050] = 9.0F;
  EXPECT_TRUE(shading_of(heights, plan).empty());
}

TEST(ClippedSegment, EndsAtTheBorder) {
  const auto middle = clipped({{-10.0, 5.0}, {30.0, 5.0}}, {0.0, 0.0}, {20.0, 10.0});
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->a.x, 0.0);
  EXPECT_EQ(middle->b.x, 20.0);
  EXPECT_EQ(middle->a.y, 5.0);
  const auto corner = clipped({{-5.0, 5.0}, {5.0, -5.0}}, {0.0, 0.0}, {20.0, 10.0});
  ASSERT_TRUE(corner) << "it touches the corner";
  EXPECT_FALSE(clipped({{-5.0, 4.0}, {4.0, -5.0}}, {0.0, 0.0}, {20.0, 10.0}));
  EXPECT_FALSE(clipped({{21.0, 1.0}, {21.0, 9.0}}, {0.0, 0.0}, {20.0, 10.0}));
  const auto inside = clipped({{3.0, 4.0}, {5.0, 6.0}}, {0.0, 0.0}, {20.0, 10.0});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->a.x, 3.0);
  EXPECT_EQ(inside->b.y, 6.0);
}

}  // namespace
}  // namespace farlod
