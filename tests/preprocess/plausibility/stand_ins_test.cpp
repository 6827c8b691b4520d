// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/stand_ins.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

namespace farlod::plausibility {
namespace {

using Heights = std::vector<std::optional<float>>;
using testing::ElementsAre;
using testing::Optional;

/// How many pixels of `number` are taken out of a raster whose others are these.
std::size_t taken(float number, Heights heights_m, HeightsOf of = HeightsOf::ground) {
  heights_m.insert(heights_m.end(), {number, number});
  const std::size_t all = heights_m.size();
  std::size_t pixels = 0;
  for (const StandIn& found : take_out_stand_ins(heights_m, of)) pixels += found.pixels;
  EXPECT_EQ(static_cast<std::size_t>(std::count(heights_m.begin(), heights_m.end(), std::nullopt)), pixels);
  EXPECT_EQ(heights_m.size(), all);
  return pixels;
}

TEST(StandIns, AreNumbersThatNoPlaceOnLandHas) {
  for (const float number : {-9999.0F, -99999.0F, -32768.0F, -32767.0F, 32767.0F, 99999.0F, -1e30F,
                             std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max()})
    EXPECT_EQ(taken(number, {480.0F, 500.0F}), 2u) << number;
}

TEST(StandIns, AreNotTheDepthsAndSummitsOfTheEarth) {
  for (const float height_m : {-430.0F, -7.0F, 0.5F, 8848.0F}) EXPECT_EQ(taken(height_m, {480.0F, 500.0F}), 0u) << height_m;
}

TEST(StandIns, AreZerosFarBelowAllOtherHeights) {
  EXPECT_EQ(taken(0.0F, {480.0F, 500.0F}), 2u);
  EXPECT_EQ(taken(0.0F, {480.0F, 500.0F}, HeightsOf::surfaces), 2u);
  EXPECT_EQ(taken(0.0F, {25.0F, 40.0F}), 2u);
  EXPECT_EQ(taken(-1.0F, {25.0F, 40.0F}), 2u);
  EXPECT_EQ(taken(-1.0F, {0.0F, 25.0F, 40.0F}), 3u) << "both";
}

TEST(StandIns, AreNoZerosOfASeaOrOfARasterThatCountsFromItsOwnGround) {
  EXPECT_EQ(taken(0.0F, {0.4F, 25.0F, 480.0F}), 0u) << "a coast";
  EXPECT_EQ(taken(0.0F, {-2.0F, 480.0F}), 0u) << "a polder";
  EXPECT_EQ(taken(-1.0F, {-1.2F, 480.0F}), 0u) << "a polder";
  EXPECT_EQ(taken(0.0F, {}), 0u) << "a plain";
  EXPECT_EQ(taken(0.0F, {25.0F, 40.0F}, HeightsOf::surfaces), 0u) << "roofs above a ground at 0";
}

TEST(StandIns, ComeMostFrequentFirstAndLeaveTheOthersAsTheyAre) {
  Heights heights_m{100.0F, -9999.0F, std::nullopt, -32768.0F, -32768.0F, 101.5F};
  const std::vector<StandIn> found = take_out_stand_ins(heights_m, HeightsOf::ground);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].height_m, -32768.0F);
  EXPECT_EQ(found[0].pixels, 2u);
  EXPECT_EQ(found[1].height_m, -9999.0F);
  EXPECT_THAT(heights_m, ElementsAre(Optional(100.0F), std::nullopt, std::nullopt, std::nullopt, std::nullopt, Optional(101.5F)));
}

}  // namespace
}  // namespace farlod::plausibility
