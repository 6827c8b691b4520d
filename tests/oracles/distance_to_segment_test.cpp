// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/distance_to_segment.hpp"

#include <gtest/gtest.h>

namespace farlod {
namespace {

TEST(DistanceToSegment, IsThatOfTheNearestPlace) {
  EXPECT_EQ(distance_to_segment({3.0, -10.0}, {3.0, 10.0}), 3.0);
  EXPECT_EQ(distance_to_segment({3.0, 4.0}, {30.0, 40.0}), 5.0);
  EXPECT_EQ(distance_to_segment({30.0, 40.0}, {3.0, 4.0}), 5.0);
  EXPECT_EQ(distance_to_segment({3.0, 4.0}, {3.0, 4.0}), 5.0) << "both ends in one place";
  EXPECT_EQ(distance_to_segment({-1.0, 0.0}, {2.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace farlod
