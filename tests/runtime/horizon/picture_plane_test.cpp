// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/picture_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace farlod {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(PicturePlane, TheSkyAboveASegmentOfAnyLengthIsLambertsFormula) {
  const PicturePlane picture({{1.0, 0.0}, 4.0}, {0.0, 0.0, 1.0}, SkyWeight::cosine);
  for (const double y : {0.0, 0.3, 20.0, 1e5})
    for (const double rise : {0.0, 1.0, -0.7})
      for (double t = 1e-9; t < 4.0; t *= 1.1) {
        // The upright borders are upright, so only the segment's own term counts: angle × the height of its plane's unit normal
        const long double top = static_cast<long double>(y) + static_cast<long double>(rise) * t;
        const long double ahead = 0.0L - y * t, aside = y - top, up = t;
        const long double across = std::sqrt(ahead * ahead + aside * aside + up * up);
        const auto expected = static_cast<double>(std::atan2(across, 1.0L + y * top) * up / across);
        if (top < 0.0L) continue;
        // The product of both lengths, a root, a quotient, a series and three products of it: some ten roundings
        EXPECT_NEAR(picture.sky_above({0.0, y}, {t, y + rise * t}), expected, 10.0 * epsilon * expected) << y << ", " << t;
      }
}

TEST(PicturePlane, TheFloorIsTheLevelOrTheOwnPlane) {
  const Wedge wedge{{1.0, 0.0}, 1.0};
  const auto floor_of = [&](const Point3d& normal) {
    const PicturePlane picture(wedge, normal, SkyWeight::cosine);
    return std::vector<PicturePlane::Segment>(picture.floor().begin(), picture.floor().end());
  };
  const auto in_front = floor_of({0.8, 0.0, 0.6});
  ASSERT_EQ(in_front.size(), 1U);
  EXPECT_EQ(in_front[0].left.y, 0.0);
  EXPECT_EQ(in_front[0].right.y, 0.0);
  const auto behind = floor_of({-0.6, 0.0, 0.8});
  ASSERT_EQ(behind.size(), 1U);
  EXPECT_NEAR(behind[0].at(0.5), 0.75, epsilon);
  // It looks away to the right, and turns in the middle of the wedge
  const auto both = floor_of({0.3, -0.6, std::sqrt(0.55)});
  ASSERT_EQ(both.size(), 2U);
  EXPECT_NEAR(both[0].right.t, 0.5, epsilon);
  EXPECT_EQ(both[0].right.y, 0.0);
  EXPECT_NEAR(both[1].right.y, 0.3 / std::sqrt(0.55), epsilon);
  // Who does not look up sees nothing behind himself
  EXPECT_EQ(floor_of({0.6 / 3.0, -1.2 / 3.0, -std::sqrt(0.8)}).size(), 1U);
  EXPECT_TRUE(floor_of({-1.0, 0.0, 0.0}).empty());
}

}  // namespace
}  // namespace farlod
