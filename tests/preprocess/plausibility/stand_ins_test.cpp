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

/// Of 300 pixels, zeros and others that are so many different numbers from 22 m on.
std::size_t zeros_taken(std::size_t zeros, std::size_t different) {
  Heights heights_m(zeros, 0.0F);
  for (std::size_t n = zeros; n < 300; ++n) heights_m.emplace_back(22.0F + 0.3F * static_cast<float>(n % different));
  std::size_t pixels = 0;
  for (const StandIn& found : take_out_stand_ins(heights_m, HeightsOf::surfaces)) pixels += found.pixels;
  return pixels;
}

TEST(StandIns, AreZerosOfASurfaceModelThatHasGroundAboveThem) {
  EXPECT_EQ(zeros_taken(40, 50), 40U) << "a block without data";
  EXPECT_EQ(zeros_taken(1, 50), 1U);
  EXPECT_EQ(zeros_taken(40, 16), 0U) << "towers of a few levels";
  EXPECT_EQ(zeros_taken(100, 50), 0U) << "streets among towers";
}

/// A ground, or a town, between 500 and 560 m, and `number` in one of 100 pixels.
Heights heights_with(float number, std::size_t pixels = 40) {
  Heights heights_m;
  for (std::size_t n = 0; n < 100 * pixels; ++n)
    heights_m.emplace_back(n % 100 == 7 ? number : 500.0F + 0.6F * static_cast<float>(n % 101));
  return heights_m;
}

TEST(StandIns, AreNumbersApartFromAllOthers) {
  for (const float number : {-100.0F, 1.0F, 255.0F, 8888.0F}) {
    Heights heights_m = heights_with(number);
    EXPECT_THAT(take_out_stand_ins(heights_m, HeightsOf::ground), ElementsAre(testing::FieldsAre(number, 40U, 7U)));
  }
  Heights surfaces_m = heights_with(-100.0F);
  EXPECT_EQ(take_out_stand_ins(surfaces_m, HeightsOf::surfaces).size(), 1U);
}

TEST(StandIns, AreNoLakesTowersAndSinglePixels) {
  Heights lake_m = heights_with(460.0F);
  EXPECT_TRUE(take_out_stand_ins(lake_m, HeightsOf::ground).empty()) << "40 m below the town";
  Heights shore_m = heights_with(-100.0F);
  shore_m.emplace_back(200.0F);
  EXPECT_TRUE(take_out_stand_ins(shore_m, HeightsOf::ground).empty()) << "a slope leads down";
  Heights tower_m = heights_with(800.0F);
  EXPECT_TRUE(take_out_stand_ins(tower_m, HeightsOf::surfaces).empty());
  Heights pit_m = heights_with(-100.0F, 15);
  EXPECT_TRUE(take_out_stand_ins(pit_m, HeightsOf::ground).empty());
  Heights levels_m(100, 10.0F);
  levels_m.resize(200, 300.0F);
  levels_m.resize(300, 310.0F);
  EXPECT_TRUE(take_out_stand_ins(levels_m, HeightsOf::surfaces).empty()) << "a model of a few levels";
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

/// Whether what is taken out of these heights is another unit.
std::string sign(Heights heights_m) {
  const auto found = take_out_stand_ins(heights_m, HeightsOf::ground);
  const auto left = std::count_if(heights_m.begin(), heights_m.end(), [](const auto& m) { return m.has_value(); });
  return sign_of_another_unit(found, static_cast<std::size_t>(left)).value_or("");
}

Heights relief(float low, float step, std::size_t different) {
  Heights heights_m;
  for (std::size_t n = 0; n < 2000; ++n) heights_m.emplace_back(low + step * static_cast<float>(n % different));
  return heights_m;
}

TEST(StandIns, AreNoneWhereTheyAreAReliefInAnotherUnit) {
  using testing::HasSubstr;
  EXPECT_THAT(sign(relief(9800.0F, 2.0F, 400)), testing::AllOf(HasSubstr("different numbers from 9852 to 10598"),
                                                               HasSubstr("-scale 0.01"), HasSubstr("centimetres")));
  EXPECT_THAT(sign(relief(2e6F, 10.0F, 400)), HasSubstr("Are they in millimetres?"));
  EXPECT_THAT(sign(relief(-1e9F, 1000.0F, 400)), HasSubstr("another quantity"));
  EXPECT_EQ(sign(relief(9990.0F, 1.0F, 50)), "") << "codes of no data";
  EXPECT_EQ(sign(relief(9000.0F, 2.0F, 800)), "") << "most are heights";
  Heights one = relief(-10'000.0F, 1.0F, 120);
  one.insert(one.end(), 4000, -9999.0F);
  EXPECT_EQ(sign(one), "") << "one number is most of them";
}

}  // namespace
}  // namespace farlod::plausibility
