// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/frame.hpp"

namespace farlod {
namespace {

CitySettings some_city() {
  CitySettings settings;
  settings.size_m = 2500.0;
  settings.seed = 11;
  return settings;
}

TEST(CityLayout, BlocksLieWithinTheCity) {
  const CitySettings settings = some_city();
  const CityLayout layout(settings);
  for (std::int64_t k = 0; k < layout.block_count(); ++k) {
    const Box2d block = layout.rectangle(layout.block_at(k));
    EXPECT_FALSE(block.empty());
    for (const double x : {block.low.x, block.low.y, block.high.x, block.high.y}) EXPECT_LE(std::abs(x), 0.5 * settings.size_m);
  }
}

TEST(CityLayout, StreetsAreAtLeastAsWideAsAskedFor) {
  const CitySettings settings = some_city();
  const CityLayout layout(settings);
  int boulevards = 0;
  for (std::int32_t i = 0; i + 1 < layout.columns(); ++i) {
    const double width_m = on_plan_grid_m(layout.rectangle({i + 1, 0}).low.x - layout.rectangle({i, 0}).high.x);
    EXPECT_GE(width_m, settings.avenue_width_m);
    boulevards += width_m > settings.avenue_width_m ? 1 : 0;
  }
  EXPECT_GT(boulevards, 0);
  for (std::int32_t j = 0; j + 1 < layout.rows(); ++j)
    EXPECT_GE(on_plan_grid_m(layout.rectangle({0, j + 1}).low.y - layout.rectangle({0, j}).high.y), settings.street_width_m);
}

TEST(CityLayout, TheWidestStreetsAllowedStillLeaveBlocks) {
  CitySettings settings;
  for (double size_m = 100.0; size_m < 700.0; size_m += 30.0) {
    settings.size_m = size_m;
    settings.avenue_spacing_m = settings.street_spacing_m = 60.0;
    settings.avenue_width_m = settings.street_width_m = 15.0;
    const CityLayout layout(settings);
    for (std::int64_t k = 0; k < layout.block_count(); ++k) EXPECT_FALSE(layout.rectangle(layout.block_at(k)).empty()) << size_m;
  }
}

TEST(CityLayout, AvenuesHaveTheBearingOfTheRotation) {
  for (const double bearing_deg : {0.0, 29.0, 61.5, 90.0, 135.0}) {
    const Point2d along_avenue = PlanRotation(bearing_deg).city_from_plan({0.0, 1.0});
    // Both are within a few units in the last place of the angle
    EXPECT_DOUBLE_EQ(azimuth_of(along_avenue).degrees(), bearing_deg);
  }
}

TEST(CityLayout, SidesOfABlockCloseUp) {
  const Box2d block = CityLayout(some_city()).rectangle({3, 4});
  for (int side = 0; side < 4; ++side) {
    const LotFrame here = side_frame(block, side), next = side_frame(block, (side + 1) % 4);
    EXPECT_DOUBLE_EQ(here.plan_from_lot({side_length_m(block, side), 0}).x, next.corner.x);
    EXPECT_DOUBLE_EQ(here.plan_from_lot({side_length_m(block, side), 0}).y, next.corner.y);
  }
}

}  // namespace
}  // namespace farlod
