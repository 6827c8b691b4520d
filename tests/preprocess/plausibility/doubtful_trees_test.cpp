// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/doubtful_trees.hpp"

#include <gmock/gmock.h>

namespace farlod::plausibility {
namespace {

std::string doubt_about(int count, double unit) {
  HeightsOfTrees heights;
  for (int n = 0; n < count; ++n) heights.add(unit * (3 + n % 25));
  return heights.doubt("Convert them").value_or("no doubt");
}

TEST(DoubtfulTrees, CentimetresAreToldByTheirMedian) {
  EXPECT_EQ(doubt_about(50, 100.0),
            "half of its 50 heights of trees are more than 1500 m, and no tree is higher than 130 m: are they in centimetres, or "
            "elevations? Convert them");
  EXPECT_EQ(doubt_about(50, 1.0), "no doubt");
  EXPECT_EQ(doubt_about(9, 100.0), "no doubt") << "a few slips";
}

TEST(DoubtfulTrees, SomeOfManyTellTheMedian) {
  EXPECT_THAT(doubt_about(400'000, 100.0), testing::StartsWith("half of its 400000 heights of trees are more than 1500 m"));
}

}  // namespace
}  // namespace farlod::plausibility
