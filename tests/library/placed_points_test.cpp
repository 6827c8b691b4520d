// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "farlod/package.hpp"
#include "farlod/points.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {
namespace {

class PlacedPoints : public testing::Test {
 protected:
  Package package_{PackedSample::shared().folder()};
};

/// Up to 200 m from the north-up rectangle around the grid: farther away, a point has no data and counts in no figure.
TEST_F(PlacedPoints, EndWhereThoseOfPixelsDo) {
  const Box2d& outline = package_.description().outline_projected;
  const Point2d middle = 0.5 * (outline.low + outline.high);
  const double near_m = answered_beyond_grid_m - 1.0, far_m = answered_beyond_grid_m + 1.0;
  const std::vector<double> x{outline.high.x + near_m, outline.high.x + far_m, outline.low.x - near_m, middle.x, middle.x};
  const std::vector<double> y{middle.y, middle.y, middle.y, outline.low.y - far_m, outline.high.y + near_m};
  const PointAnswers answers = evaluate_points(package_, {x, y});
  for (const std::size_t n : {0U, 2U, 4U}) EXPECT_FALSE(std::isnan(answers.svf[n])) << n;
  for (const std::size_t n : {1U, 3U}) {
    EXPECT_TRUE(std::isnan(answers.svf[n])) << n;
    EXPECT_TRUE(std::isnan(answers.height_m[n])) << n;
  }
  EXPECT_EQ(answers.summary.receivers, 3U);
  EXPECT_EQ(answers.summary.beyond_grid, 2U);
  EXPECT_EQ(answers.summary.no_data, 0U);
}

/// Points have heights above ground of their own, which go before those of Placing, and behind those above sea level.
TEST_F(PlacedPoints, StandAsHighAboveTheGroundAsTheirPointsSay) {
  const Point2d beyond = package_.description().outline_projected.high + Point2d{50.0, 50.0};
  const double nan = std::nan("");
  const std::vector<double> x(4, beyond.x), y(4, beyond.y), z{nan, nan, nan, 700.0}, above{4.0, nan, 0.0, 5.0};
  const PointAnswers answers = evaluate_points(package_, {x, y, z, {}, {}, above}, {HeightAbove::ground, 2.0});
  EXPECT_NEAR(answers.above_ground_m[0], 4.0, 1e-4);
  EXPECT_NEAR(answers.above_ground_m[1], 2.0, 1e-4);
  EXPECT_NEAR(answers.above_ground_m[2], 0.01, 1e-4) << "a centimetre above the ground";
  EXPECT_NEAR(answers.height_m[3], 700.0, 1e-3);
  const std::vector<double> below(4, -1.0);
  EXPECT_THROW((void)evaluate_points(package_, {x, y, {}, {}, {}, below}), InvalidPoint);
}

/// One looks straight up from above the city, one along the level.
TEST_F(PlacedPoints, OfTwoValuesTheMedianIsBetweenThem) {
  const Box2d& outline = package_.description().outline_projected;
  const Point2d middle = 0.5 * (outline.low + outline.high);
  const std::vector<double> x(2, middle.x), y(2, middle.y), z(2, 9000.0);
  const std::vector<Angle> azimuth(2), tilt{Angle::degrees(0.0), Angle::degrees(90.0)};
  const PointAnswers answers = evaluate_points(package_, {x, y, z, azimuth, tilt});
  ASSERT_LT(*answers.summary.svf_min, 0.51);
  EXPECT_NEAR(*answers.summary.svf_median, *answers.summary.svf_mean, 1e-4);
}

}  // namespace
}  // namespace farlod::library
