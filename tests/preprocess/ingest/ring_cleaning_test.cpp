// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/model_builder/ring_cleaning.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace farlod::ingest {
namespace {

const Point3d a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};

TEST(RingCleaning, TakesTheClosingPointAway) {
  Ring ring{a, b, c, d, a};
  const RingFindings findings = clean_ring(ring, RingEnd::repeats_first);
  EXPECT_EQ(findings.state, RingState::usable);
  EXPECT_FALSE(findings.was_open);
  EXPECT_EQ(findings.repeated_vertices, 0u);
  EXPECT_EQ(ring, (Ring{a, b, c, d}));
}

TEST(RingCleaning, ClosesAnOpenRingAndTellsTheGap) {
  Ring ring{a, b, c, d};
  const RingFindings findings = clean_ring(ring, RingEnd::repeats_first);
  EXPECT_TRUE(findings.was_open);
  EXPECT_EQ(findings.gap, 1.0);
  EXPECT_EQ(ring, (Ring{a, b, c, d}));
}

TEST(RingCleaning, AnImpliedEndIsNotOpen) {
  Ring ring{a, b, c};
  EXPECT_FALSE(clean_ring(ring, RingEnd::implied).was_open);
}

TEST(RingCleaning, TakesRepeatedVerticesOutAcrossTheEndToo) {
  Ring ring{a, a, b, c, c, c, d, a};
  const RingFindings findings = clean_ring(ring, RingEnd::implied);
  EXPECT_EQ(findings.repeated_vertices, 4u);
  EXPECT_EQ(ring, (Ring{a, b, c, d}));
}

TEST(RingCleaning, ThreePointsMustDiffer) {
  for (Ring ring : {Ring{}, Ring{a}, Ring{a, b}, Ring{a, b, a}, Ring{a, b, a, b}, Ring{a, a, a, a}})
    EXPECT_EQ(clean_ring(ring, RingEnd::repeats_first).state, RingState::too_few_points);
  Ring spike{a, b, a, c};
  EXPECT_EQ(clean_ring(spike, RingEnd::implied).state, RingState::usable);
}

TEST(RingCleaning, CoordinatesMustBeFiniteAndOnEarth) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 2.0 * farthest_coordinate}) {
    Ring ring{a, b, {1.0, bad, 0.0}};
    EXPECT_EQ(clean_ring(ring, RingEnd::implied).state, RingState::unreadable_coordinate);
  }
}

}  // namespace
}  // namespace farlod::ingest
