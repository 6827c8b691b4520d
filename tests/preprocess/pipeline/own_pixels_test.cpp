// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/own_pixels.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace farlod::pipeline {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint8_t east = JoinedPixels::east, north = JoinedPixels::north;

TEST(WallsOfPixels, StandBetweenHeightsThatAreNotJoined) {
  const package::SurfacePixels pixels{{}, 1.0, 3, 2, {}, {}};
  // The middle of the northern row is a block: its western, eastern and southern sides are walls
  const PixelHeights block{{1, 1, 1, 1, 9, 1}, {east | north, east, north, 0, 0, 0}};
  EXPECT_EQ(walls_of(pixels, block), 3U);
}

TEST(WallsOfPixels, AreNoneWhereThereIsNoHeight) {
  const package::SurfacePixels pixels{{}, 1.0, 3, 2, {}, {}};
  const PixelHeights hole{{1, none, none, 1, none, 1}, {north, 0, 0, 0, 0, 0}};
  EXPECT_EQ(walls_of(pixels, hole), 0U);
}

}  // namespace
}  // namespace farlod::pipeline
