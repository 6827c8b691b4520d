// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/spikes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace farlod::tiles {
namespace {

using Ring = std::vector<Point3d>;

const Point3d a{0, 0, 5}, b{10, 0, 5}, c{10, 8, 5}, d{0, 8, 5};

/// A ring turned about the origin: what lay on a line does so no longer, by the last bits.
Ring turned(Ring ring, double angle_rad) {
  for (Point3d& p : ring)
    p = {std::cos(angle_rad) * p.x - std::sin(angle_rad) * p.y, std::sin(angle_rad) * p.x + std::cos(angle_rad) * p.y, p.z};
  return ring;
}

TEST(Spikes, AreTakenOutWhereverTheRingBegins) {
  const Point3d foot{10, 4, 5}, tip{14, 4, 5};
  for (std::ptrdiff_t begin = 0; begin < 7; ++begin) {
    Ring ring{a, b, foot, tip, foot, c, d};
    std::rotate(ring.begin(), ring.begin() + begin, ring.end());
    const Ring given = turned(ring, 0.3);
    const auto despiked = without_spikes(given);
    ASSERT_TRUE(despiked) << begin;
    EXPECT_EQ(despiked->ring.size(), 5U);
    ASSERT_EQ(despiked->spikes.size(), 1U);
    EXPECT_EQ(given[despiked->spikes[0].vertex], turned({tip}, 0.3)[0]);
    EXPECT_EQ(despiked->spikes[0].tip, turned({tip}, 0.3)[0]);
    constexpr double rounding_m = 16 * 2.3e-16 * 14;  // of a few sums and products of numbers up to 14
    EXPECT_NEAR(despiked->spikes[0].length_m, 4.0, rounding_m);
  }
}

TEST(Spikes, MayComeBackPartOfTheWayOrFarther) {
  EXPECT_EQ(without_spikes(Ring{a, {14, 0, 5}, b, c, d})->ring, (Ring{a, b, c, d}));
  EXPECT_EQ(without_spikes(Ring{{2, 0, 5}, {14, 0, 5}, a, {0, -3, 5}, {14, -3, 5}, {14, -1, 5}, {2, -1, 5}})->spikes.size(), 1U);
}

TEST(Spikes, OfSeveralVerticesAreTakenOutFromTheTip) {
  const Point3d foot{10, 4, 5}, knee{14, 4, 5}, tip{14, 9, 5};
  const Ring hooked{a, b, foot, knee, tip, knee, foot, c, d};
  for (std::ptrdiff_t begin = 0; begin < 9; ++begin) {
    Ring ring = hooked;
    std::rotate(ring.begin(), ring.begin() + begin, ring.end());
    const auto despiked = without_spikes(ring);
    ASSERT_TRUE(despiked) << begin;
    Ring left = despiked->ring;
    std::rotate(left.begin(), std::find(left.begin(), left.end(), a), left.end());
    EXPECT_EQ(left, (Ring{a, b, foot, c, d})) << begin;
    ASSERT_EQ(despiked->spikes.size(), 2U) << begin;
    EXPECT_EQ(despiked->spikes[0].tip, tip) << begin;
    EXPECT_EQ(despiked->spikes[1].tip, knee) << begin;
  }
}

TEST(Spikes, AreAsNarrowAsFilesRound) {
  const auto with_width = [](double width_m) { return Ring{a, b, {10, 4, 5}, {14, 4, 5}, {10, 4 + width_m, 5}, c, d}; };
  EXPECT_TRUE(without_spikes(with_width(0.9 * spike_width_m)));
  EXPECT_FALSE(without_spikes(with_width(1.1 * spike_width_m)));
}

TEST(Spikes, AreNoHonestCorners) {
  EXPECT_FALSE(without_spikes(Ring{a, b, c, d}));
  EXPECT_FALSE(without_spikes(Ring{a, b, {10, 8, 5}, {5, 8, 5}, d})) << "a vertex on a straight side";
  EXPECT_FALSE(without_spikes(Ring{a, b, c, {0, 0.01, 5}})) << "an acute gore";
  EXPECT_FALSE(without_spikes(Ring{a, b, {10, 4, 5}, {10.005, 4, 5}, {10, 4.0008, 5}, c, d})) << "half a centimetre";
  // A slit of half a millimetre is thin, but no corner of it turns back
  EXPECT_FALSE(without_spikes(Ring{a, b, {10, 0.0005, 5}, {0, 0.0005, 5}}));
  // A keyhole's bridge is run there and back, but around something
  EXPECT_FALSE(
      without_spikes(Ring{a, b, c, d, {0, 4, 5}, {4, 4, 5}, {4, 5, 5}, {6, 5, 5}, {6, 3, 5}, {4, 3, 5}, {4, 4, 5}, {0, 4, 5}}));
}

TEST(Spikes, OfALongCombAreTakenOutOneByOne) {
  // With the cost of the whole ring for each, this would take minutes
  constexpr int teeth = 100000;
  Ring comb{a, b};
  for (int k = 1; k <= teeth; ++k) {
    const Point3d foot{10, 8.0 * k / (teeth + 1), 5}, tip = foot + Point3d{1, 0, 0};
    comb.insert(comb.end(), {foot, tip, foot});
  }
  comb.insert(comb.end(), {c, d});
  const auto despiked = without_spikes(comb);
  ASSERT_TRUE(despiked);
  EXPECT_EQ(despiked->spikes.size(), static_cast<std::size_t>(teeth));
  EXPECT_EQ(despiked->ring.size(), 4U + teeth);
}

TEST(Spikes, OfWhichNothingElseIsLeftStay) {
  EXPECT_FALSE(without_spikes(Ring{a, b, {5, 0.0001, 5}})) << "a sliver of a mesh";
  EXPECT_FALSE(without_spikes(Ring{a, {5, 0, 5}, b, {2, 0, 5}}));
  EXPECT_FALSE(without_spikes(Ring{a, {5, 0, 5}, b, {5, 0, 5}}));
}

}  // namespace
}  // namespace farlod::tiles
