// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/receiver_patches.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace farlod {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Squares of 10 m, layers from −2 m.
ReceiverPatches two_by_two() { return {20.0, 2, {-2.0F, 3.0F, 9.5F}}; }

bool holds(const PatchBox& box, const Point3f& p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y && p.z >= box.z_low_m &&
         p.z <= box.z_high_m;
}

TEST(ReceiverPatches, EachPlaceLiesInTheBoxOfItsPatch) {
  const ReceiverPatches patches = two_by_two();
  std::set<std::uint32_t> met;
  for (float x = 0.0F; x <= 20.0F; x += 2.5F)
    for (float y = 0.0F; y <= 20.0F; y += 2.5F)
      for (const float z : {-2.0F, 0.0F, 2.9F, 3.0F, 9.49F, 9.5F, 400.0F}) {
        const auto patch = patches.patch_of({x, y, z});
        ASSERT_TRUE(patch);
        EXPECT_TRUE(holds(patches.box(*patch), {x, y, z})) << x << ", " << y << ", " << z;
        met.insert(*patch);
      }
  EXPECT_EQ(met.size(), patches.count());
  EXPECT_EQ(*met.rbegin(), patches.count() - 1);
}

TEST(ReceiverPatches, BelowTheLowestLevelThereIsNone) {
  EXPECT_FALSE(two_by_two().patch_of({5.0F, 5.0F, std::nextafter(-2.0F, -infinite)}));
  EXPECT_FALSE(two_by_two().patch_of({5.0F, 5.0F, std::numeric_limits<float>::quiet_NaN()}));
  EXPECT_TRUE(two_by_two().patch_of({5.0F, 5.0F, -2.0F}));
}

TEST(ReceiverPatches, TheUppermostLayerHasNoLid) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.ceiling_m(0), 3.0);
  EXPECT_EQ(patches.ceiling_m(2), std::numeric_limits<double>::infinity());
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 1e6F}), patches.number(0, 2));
}

TEST(ReceiverPatches, AreNumberedFromTheSouthWestAndLayerByLayer) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.patch_of({1.0F, 1.0F, 0.0F}), 0U);
  EXPECT_EQ(patches.patch_of({19.0F, 1.0F, 0.0F}), 1U);
  EXPECT_EQ(patches.patch_of({1.0F, 19.0F, 0.0F}), 2U);
  EXPECT_EQ(patches.patch_of({1.0F, 1.0F, 5.0F}), 4U);
}

TEST(ReceiverPatches, ABorderBelongsToTheEastAndTheNorth) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.patch_of({10.0F, 0.0F, 0.0F}), 1U);
  EXPECT_EQ(patches.patch_of({0.0F, 10.0F, 0.0F}), 2U);
  EXPECT_EQ(patches.patch_of({std::nextafter(10.0F, 0.0F), 0.0F, 0.0F}), 0U);
}

TEST(ReceiverPatches, WhatIsRoundedOutOfTheCellStaysInIt) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.patch_of({20.0F, 20.0F, 0.0F}), 3U);
  EXPECT_EQ(patches.patch_of({-1e-6F, -1e-6F, 0.0F}), 0U);
}

TEST(ReceiverPatches, LayersWithoutThicknessHoldNothing) {
  const ReceiverPatches patches(20.0, 1, {0.0F, 2.0F, 2.0F, 2.0F, 7.0F});
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 1.0F}), 0U);
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 2.0F}), 3U);
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 7.0F}), 4U);
  // All at one height: a flat, empty cell
  EXPECT_EQ(ReceiverPatches(20.0, 1, {0.0F, 0.0F}).patch_of({5.0F, 5.0F, 0.0F}), 1U);
}

}  // namespace
}  // namespace farlod
