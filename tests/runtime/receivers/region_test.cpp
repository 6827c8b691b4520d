// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "farlod/error.hpp"

namespace farlod {
namespace {

Region::Ring square(double low, double high) { return {{low, low}, {high, low}, {high, high}, {low, high}}; }

TEST(Region, HasHoles) {
  const Region region({square(0, 10), square(4, 6)});
  EXPECT_TRUE(region.contains({1, 1}));
  EXPECT_FALSE(region.contains({5, 5}));
  EXPECT_TRUE(region.contains({7, 5}));
  EXPECT_FALSE(region.contains({11, 5}));
  EXPECT_EQ(region.outline(), (Box2d{{0, 0}, {10, 10}}));
}

TEST(Region, GivesAPlaceOnASharedEdgeToOneOfTwoPolygons) {
  const Region west({{{0, 0}, {3, 1}, {2, 7}, {0, 8}}}), east({{{3, 1}, {9, 0}, {9, 8}, {2, 7}}});
  for (int n = 0; n <= 100; ++n) {
    const double share = n / 100.0;
    const Point2d p{3.0 - share, 1.0 + 6.0 * share};
    EXPECT_EQ(west.contains(p) + east.contains(p), 1) << n;
  }
}

TEST(Region, OfNothingHoldsNothing) {
  EXPECT_FALSE(Region({}).contains({0, 0}));
  EXPECT_FALSE(Region({{}, {{1, 1}}, {{1, 1}, {2, 2}}}).contains({1.5, 1.5}));
}

TEST(Region, IsThatOfAStarWithManyPoints) {
  // A ring whose radius is known at each azimuth, of so many edges that they are divided into bands
  constexpr int corners = 20000;
  const auto radius = [](double t) { return 100.0 + 40.0 * std::sin(7.0 * t) + 5.0 * std::sin(90.0 * t); };
  Region::Ring ring;
  for (int n = 0; n < corners; ++n) {
    const double t = 2.0 * std::numbers::pi * n / corners;
    ring.push_back({500000.0 + radius(t) * std::cos(t), 5e6 + radius(t) * std::sin(t)});
  }
  const Region region({ring});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-150.0, 150.0);
  int inside = 0;
  for (int n = 0; n < 20000; ++n) {
    const Point2d p{place(random), place(random)};
    const double distance = std::hypot(p.x, p.y), at = radius(std::atan2(p.y, p.x));
    if (std::abs(distance - at) < 0.5) continue;
    ASSERT_EQ(region.contains({500000.0 + p.x, 5e6 + p.y}), distance < at) << p.x << ", " << p.y;
    inside += distance < at ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
}

TEST(Region, OfPlacesNowhereIsRefused) {
  EXPECT_THROW(Region({{{0, 0}, {1, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}}}), InvalidArgument);
  EXPECT_THROW(Region({{{0, 0}, {1, 0}, {1, 1e9}}}), InvalidArgument);
}

}  // namespace
}  // namespace farlod
