// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/urban_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace farlod {
namespace {

TEST(UrbanField, StaysBetweenNothingAndTheHeartOfTheCore) {
  CitySettings settings;
  settings.size_m = 6000.0;
  const UrbanField field(settings);
  for (double x = -3000.0; x <= 3000.0; x += 97.0)
    for (double y = -3000.0; y <= 3000.0; y += 97.0) {
      EXPECT_GT(field.urbanity({x, y}), 0.0);
      EXPECT_LE(field.urbanity({x, y}), 1.0);
    }
}

TEST(UrbanField, CitiesHaveACoreAndVillagesHaveNone) {
  CitySettings settings;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    settings.seed = seed;
    settings.size_m = 120.0;
    EXPECT_LT(UrbanField(settings).urbanity({}), UrbanField::core_urbanity);
    settings.size_m = 400.0;
    EXPECT_GE(UrbanField(settings).urbanity({}), UrbanField::core_urbanity);
    settings.size_m = 4000.0;
    EXPECT_GE(UrbanField(settings).urbanity({}), UrbanField::core_urbanity);
  }
}

TEST(UrbanField, GroundStaysWithinItsRelief) {
  CitySettings settings;
  EXPECT_EQ(UrbanField(settings).ground_m({123.0, 456.0}), 0.0);
  settings.terrain_relief_m = 40.0;
  const UrbanField field(settings);
  double low_m = 40.0, high_m = 0.0;
  for (double x = -5000.0; x <= 5000.0; x += 50.0) {
    const double ground_m = field.ground_m({x, 0.5 * x});
    EXPECT_TRUE(ground_m >= 0.0 && ground_m <= 40.0);
    low_m = std::min(low_m, ground_m), high_m = std::max(high_m, ground_m);
  }
  EXPECT_GT(high_m - low_m, 20.0) << "hills of less than half the relief";
}

TEST(UrbanField, HillsidesRiseAndFallBy10To25Percent) {
  CitySettings settings;
  settings.hillside = true;
  const UrbanField field(settings);
  constexpr double step_m = 0.5;
  // A difference of two heights of at most 24 m, divided by the step
  constexpr double rounding = 4.0 * 24.0 * 2.2e-16 / step_m;
  int steps = 0, kinks = 0, rising = 0;
  for (double t = -4000.0; t < 4000.0; t += step_m, ++steps) {
    const double low_m = field.ground_m({0.96 * t, 0.28 * t}),
                 high_m = field.ground_m({0.96 * (t + step_m), 0.28 * (t + step_m)});
    EXPECT_TRUE(low_m >= 0.0 && low_m <= 24.0);
    const double slope = std::abs(high_m - low_m) / step_m;
    EXPECT_LE(slope, 0.25 + rounding);
    kinks += slope < 0.10 - rounding ? 1 : 0;
    rising += high_m > low_m ? 1 : 0;
    EXPECT_NEAR(field.ground_m({0.96 * t - 28.0, 0.28 * t + 96.0}), low_m, 1e-9) << "contours are straight";
  }
  // A ridge or a valley at least every 240 m and at most every 96 m
  EXPECT_LE(kinks, static_cast<int>(steps * step_m / 96.0) + 1);
  EXPECT_NEAR(rising, 0.5 * steps, 0.2 * steps);
}

}  // namespace
}  // namespace farlod
