// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/touching_walls.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace farlod {
namespace {

BuildingPlan house(Point2d corner, int side, double width_m, double depth_m) {
  return {.lot = {corner, side}, .width_m = width_m, .depth_m = depth_m};
}

TEST(TouchingWalls, SharedStretchesTouch) {
  const std::vector<BuildingPlan> plans{house({0, 0}, 0, 10, 8), house({10, 2}, 0, 6, 12), house({30, 0}, 0, 5, 5)};
  const TouchingWalls walls(plans);
  EXPECT_TRUE(walls.touches(0, {10, 0}, {10, 8}));
  EXPECT_TRUE(walls.touches(0, {10, 8}, {10, 0}));
  EXPECT_TRUE(walls.touches(1, {10, 2}, {10, 14}));
  EXPECT_FALSE(walls.touches(0, {0, 0}, {10, 0}));
  EXPECT_FALSE(walls.touches(0, {10, 0}, {10, 2})) << "below the neighbor's corner";
  EXPECT_FALSE(walls.touches(1, {10, 8}, {10, 14})) << "beyond the neighbor's corner";
  EXPECT_TRUE(walls.touches_any(0));
  EXPECT_TRUE(walls.touches_any(1));
  EXPECT_FALSE(walls.touches_any(2));
}

TEST(TouchingWalls, TheCentimetreDecides) {
  const std::vector<BuildingPlan> plans{house({0, 0}, 0, 10, 8), house({10.01, 0}, 0, 6, 8)};
  EXPECT_FALSE(TouchingWalls(plans).touches_any(0));
}

TEST(TouchingWalls, LotsOfAllSidesMeet) {
  // The second house faces east: its front runs from (10, 0) to (10, 8), and it lies to the west of it
  const std::vector<BuildingPlan> plans{house({10, 0}, 0, 5, 8), house({10, 0}, 1, 8, 6)};
  const TouchingWalls walls(plans);
  EXPECT_TRUE(walls.touches(0, {10, 0}, {10, 8}));
  EXPECT_TRUE(walls.touches(1, {10, 0}, {10, 8}));
}

}  // namespace
}  // namespace farlod
