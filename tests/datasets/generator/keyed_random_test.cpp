// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/keyed_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace farlod {
namespace {

TEST(KeyedRandom, SameKeySameNumbersOnEveryMachine) {
  // The first outputs of SplitMix64 for the state that the empty key gives, as its authors publish them for seed 0
  KeyedRandom random({});
  EXPECT_EQ(random.bits(), 0xE220A8397B1DCDAFU);
  EXPECT_EQ(random.bits(), 0x6E789E6AA1B965F4U);
  EXPECT_EQ(random.bits(), 0x06C45D188009454FU);
}

TEST(KeyedRandom, NeighboringKeysShareNoNumbers) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 50; ++i)
    for (std::uint64_t j = 0; j < 50; ++j) EXPECT_TRUE(seen.insert(KeyedRandom({1, i, j}).bits()).second) << i << ' ' << j;
}

TEST(KeyedRandom, NumbersStayInTheirIntervalAndFillIt) {
  KeyedRandom random({7});
  constexpr int draws = 10000, faces = 6;
  int counts[faces] = {};
  double sum = 0.0;
  for (int k = 0; k < draws; ++k) {
    const double x = random.between(-2.0, 3.0);
    ASSERT_TRUE(x >= -2.0 && x < 3.0);
    sum += x;
    const int face = random.whole(1, faces);
    ASSERT_TRUE(face >= 1 && face <= faces);
    ++counts[face - 1];
  }
  // Five standard deviations of the mean of a uniform, and of a binomial count: the draws are fixed, so this is no gamble
  EXPECT_LT(std::abs(sum / draws - 0.5), 5.0 * 5.0 / std::sqrt(12.0 * draws));
  const double share = 1.0 / faces;
  for (const int count : counts) EXPECT_LT(std::abs(count - draws * share), 5.0 * std::sqrt(draws * share * (1.0 - share)));
}

TEST(KeyedRandom, ChanceKnowsNeverAndAlways) {
  KeyedRandom random({3});
  for (int k = 0; k < 1000; ++k) {
    EXPECT_FALSE(random.chance(0.0));
    EXPECT_TRUE(random.chance(1.0));
  }
}

}  // namespace
}  // namespace farlod
