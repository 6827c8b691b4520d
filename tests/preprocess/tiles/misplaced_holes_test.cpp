// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/misplaced_holes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace farlod::tiles {
namespace {

using Ring = std::vector<Point3d>;
using Rings = std::vector<Ring>;

/// On a slope, so that the plane of the facet is none of the coordinate planes.
Ring square(double x, double y, double edge_m) {
  const auto on_slope = [](double u, double v) { return Point3d{u, v, 0.25 * u + 0.5 * v}; };
  return {on_slope(x, y), on_slope(x + edge_m, y), on_slope(x + edge_m, y + edge_m), on_slope(x, y + edge_m)};
}
Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

RingPlaces places(const Rings& rings) {
  const std::vector<std::span<const Point3d>> spans(rings.begin(), rings.end());
  return places_of_rings(spans);
}

/// The rings that are misplaced, whichever way the holes run.
std::vector<std::size_t> misplaced(Rings rings) {
  std::vector<std::size_t> found;
  for (const MisplacedHole& hole : places(rings).misplaced) found.push_back(hole.ring);
  for (std::size_t k = 1; k < rings.size(); ++k) rings[k] = reversed(rings[k]);
  std::vector<std::size_t> found_again;
  for (const MisplacedHole& hole : places(rings).misplaced) found_again.push_back(hole.ring);
  EXPECT_EQ(found, found_again);
  return found;
}

using Numbers = std::vector<std::size_t>;

TEST(MisplacedHoles, AreNoneWhereHolesLieWithin) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(4, 4, 2)}), Numbers{});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(0, 0, 2)}), Numbers{}) << "a hole may touch the outer ring";
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(3, 1, 2)}), Numbers{}) << "and another hole";
  EXPECT_FALSE(places({square(0, 0, 8), square(1, 1, 2)}).true_outer);
}

TEST(MisplacedHoles, LieOutside) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(20, 0, 2), square(1, 1, 2)}), Numbers{1});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(8, 0, 8)}), Numbers{1}) << "beside the outer ring, and touching it";
  // In the notch of an L: the boxes overlap
  const Ring l{{0, 0, 0}, {8, 0, 0}, {8, 2, 0}, {2, 2, 0}, {2, 8, 0}, {0, 8, 0}};
  EXPECT_EQ(misplaced({l, {{4, 4, 0}, {6, 4, 0}, {6, 6, 0}}}), Numbers{1});
  EXPECT_EQ(misplaced({l, {{8, 2, 0}, {2, 8, 0}, {2, 2, 0}}}), Numbers{1}) << "all corners on the outer ring";
}

TEST(MisplacedHoles, AreNotThoseThatCross) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(7, 1, 2)}), Numbers{}) << "a courtyard that sticks out";
  // A cross of two bars: no corner of one lies in the other
  const Ring lying{{0, 3, 0}, {9, 3, 0}, {9, 6, 0}, {0, 6, 0}}, standing{{3, 0, 0}, {6, 0, 0}, {6, 9, 0}, {3, 9, 0}};
  EXPECT_EQ(misplaced({lying, standing}), Numbers{});
  EXPECT_FALSE(places({lying, standing}).true_outer);
}

TEST(MisplacedHoles, AreTheOuterRingOrAnotherHoleOnceMore) {
  Ring turned = square(0, 0, 8);
  std::rotate(turned.begin(), turned.begin() + 2, turned.end());
  EXPECT_EQ(misplaced({square(0, 0, 8), turned}), Numbers{1});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(1, 1, 2)}), Numbers{2});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(1, 1, 2), square(1, 1, 2)}), (Numbers{2, 3}));
}

TEST(MisplacedHoles, LieWithinAnotherHole) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 5), square(2, 2, 1)}), Numbers{2});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(2, 2, 1), square(1, 1, 5)}), Numbers{1});
}

TEST(MisplacedHoles, ThatSurroundTheFirstRingAreTheOuterOne) {
  const RingPlaces exchanged = places({square(1, 1, 2), square(0, 0, 8), square(4, 4, 2)});
  EXPECT_EQ(exchanged.true_outer, 1U);
  EXPECT_TRUE(exchanged.misplaced.empty());
}

TEST(MisplacedHoles, OfAFacetWithoutAreaAreNotTested) {
  EXPECT_EQ(misplaced({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, square(5, 5, 1)}), Numbers{});
}

}  // namespace
}  // namespace farlod::tiles
