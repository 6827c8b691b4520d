// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/exr_runs.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

// What OpenEXR itself packs is in horizon_file_test.cpp; here are bytes by hand, and such that nobody would pack.

namespace farlod {
namespace {

std::vector<std::byte> bytes_of(const std::vector<int>& values) {
  std::vector<std::byte> result;
  for (const int v : values) result.push_back(static_cast<std::byte>(v));
  return result;
}

struct Undone {
  bool fits;
  std::vector<std::byte> pixels;
};
Undone undo(const std::vector<int>& packed, std::size_t size) {
  Undone result{false, std::vector<std::byte>(size)};
  result.fits = undo_exr_runs(bytes_of(packed), result.pixels);
  return result;
}

TEST(ExrRuns, DifferentBytesAndAlikeOnes) {
  // Low bytes 10, 13, 11 and high ones 11, 11, 11: the first as it is, then differences from 128 on
  const Undone undone = undo({-3, 10, 131, 126, 2, 128}, 6);
  EXPECT_TRUE(undone.fits);
  EXPECT_EQ(undone.pixels, bytes_of({10, 11, 13, 11, 11, 11}));
}

TEST(ExrRuns, BytesGoRoundAt256) {
  const Undone undone = undo({-4, 250, 138, 118, 0}, 4);
  EXPECT_TRUE(undone.fits);
  EXPECT_EQ(undone.pixels, bytes_of({250, 250, 4, 122}));
}

TEST(ExrRuns, TheLongestRuns) {
  // 128 of each kind, the most that a head can say
  std::vector<int> packed{127, 128, -128};
  packed.insert(packed.end(), 128, 129);
  const Undone undone = undo(packed, 256);
  ASSERT_TRUE(undone.fits);
  for (int n = 0; n < 128; ++n) {
    EXPECT_EQ(undone.pixels[static_cast<std::size_t>(2 * n)], std::byte{128}) << n;
    EXPECT_EQ(undone.pixels[static_cast<std::size_t>(2 * n + 1)], static_cast<std::byte>(128 + n + 1)) << n;
  }
}

TEST(ExrRuns, NothingIsNothing) { EXPECT_TRUE(undo({}, 0).fits); }

TEST(ExrRuns, OtherThanSoManyPixels) {
  EXPECT_FALSE(undo({}, 2).fits);
  EXPECT_FALSE(undo({2, 128}, 2).fits) << "a run too long";
  EXPECT_FALSE(undo({0, 128}, 2).fits) << "a run too short";
  EXPECT_FALSE(undo({-3, 1, 2, 3}, 2).fits) << "too many bytes";
  EXPECT_FALSE(undo({1}, 2).fits) << "a run of what?";
  EXPECT_FALSE(undo({-2, 1}, 2).fits) << "bytes that are not there";
  EXPECT_FALSE(undo({1, 128, 1, 128}, 2).fits) << "more when all is there";
}

/// Memory checkers watch this.
TEST(ExrRuns, AnyBytesStayInBounds) {
  std::mt19937 random(1);
  int fit = 0;
  for (int n = 0; n < 20000; ++n) {
    std::vector<int> packed(random() % 40);
    for (int& byte : packed) byte = static_cast<int>(random() % (n % 2 == 0 ? 256 : 12));
    fit += undo(packed, 2 * (random() % 40)).fits ? 1 : 0;
  }
  EXPECT_GT(fit, 0);
}

}  // namespace
}  // namespace farlod
