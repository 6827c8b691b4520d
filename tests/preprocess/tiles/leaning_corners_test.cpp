// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/leaning_corners.hpp"

#include <gtest/gtest.h>

#include "tests/preprocess/tiles/borders.hpp"

namespace farlod::tiles {
namespace {

using test::area_m2;

TEST(LeaningCorners, StandOutWhereNoFacetIsBelow) {
  const Segment3d leaning{{1.003, 0, 24}, {1, 0, 0}};
  const auto stands_out_m = [&](const std::vector<Point2d>& facets) { return LeaningCorner{leaning, facets}.stands_out_m(); };
  EXPECT_NEAR(stands_out_m({{-5, 0}, {0, 7}}), 0.003, 1e-12) << "to the east, away from walls to the west and the north";
  EXPECT_EQ(stands_out_m({{5, 0}, {0, 7}}), 0.0) << "along a wall";
  EXPECT_EQ(stands_out_m({{5, -1}, {1, 7}}), 0.0) << "between both walls";
  EXPECT_NEAR(stands_out_m({{4, 3}, {0, 7}}), 0.003 * 0.6, 1e-12) << "beside one";
  EXPECT_NEAR(stands_out_m({}), 0.003, 1e-12);
}

TEST(LeaningCorners, AreClosedDownToTheGroundBelowGroundedBordersAlone) {
  LeaningCorner upper{{{1.01, 0, 20}, {1.005, 0, 10}}, {{-1, 0}}}, lower{{{1.005, 0, 10}, {1, 0, 0.02}}, {{-1, 0}}};
  const auto area_below = [&](const Point3d& end) {
    Places ends(&comes_first);
    ends.insert(end);
    return area_m2(closing_below({lower, upper}, ends, [](Point2d) { return 0.0; }));
  };
  EXPECT_EQ(area_below({5, 5, 20}), 0.0);
  // Below the upper one down to the ground, and below its foot
  EXPECT_NEAR(area_below(upper.segment.a), 0.005 * (10.0 + 5.0) + 0.005 * 10.0 / 2.0, 1e-3);
}

}  // namespace
}  // namespace farlod::tiles
