// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/analytic/oracles.hpp"
#include "tests/scenes/test_data.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

// The closed forms are compared with each other and with printed figures before anything is compared with them.

namespace farlod::oracles {
namespace {

/// The spot values were printed with seven digits.
constexpr double printed = 0.5e-7;

TEST(Oracles, AgreeWithThePrintedSpotValues) {
  EXPECT_NEAR(canyon_cos(20, 20, 15, 4), 0.3390174, printed);
  EXPECT_NEAR(canyon_solid(20, 20, 15, 4), 0.2228929, printed);
  EXPECT_NEAR(round_court_cos(25, 20, 10), 0.5620174, printed);
  EXPECT_NEAR(finite_wall_cos(20, 12, 30, 7), 0.8248997, printed);
  EXPECT_NEAR(finite_wall_solid(20, 12, 30, 7), 0.7823225, printed);
}

/// What a wall hides beyond a/d is (H/d)² ∫ cos²ψ dψ from atan(a/d) to 90° at most, below (H/d)²·(d/a)³/3, over 2π, twice; the
/// rest is rounding in some ten operations.
double endless_error(double H, double d, double a) {
  return std::pow(H / d, 2) * std::pow(d / a, 3) / (3 * pi) + 10 * std::numeric_limits<double>::epsilon();
}

TEST(Oracles, AVeryLongWallIsAnEndlessOne) {
  EXPECT_NEAR(finite_wall_cos(20, 12, 1e5, 1e5), wall_cos(20, 12), endless_error(20, 12, 1e5));
  // By solid angle the tail weighs sin β ≤ H/d · cos ψ instead: (H/d)·(d/a)²/2, over 2π, twice
  EXPECT_NEAR(finite_wall_solid(20, 12, 1e6, 1e6), wall_solid(20, 12), 20.0 / 12 * std::pow(12 / 1e6, 2) / (2 * pi) + 1e-15);
}

TEST(Oracles, ACourtWithoutFarWallsIsACanyon) {
  const double half_width = 8, H = 11;
  const double court = 4 * court_quadrant_cos(half_width, 1e6, H);
  // The two ends of the court hide less than an endless wall that far away
  EXPECT_NEAR(court, canyon_cos(H, H, 2 * half_width, half_width), 2 * (1 - wall_cos(H, 1e6)) + 1e-15);
}

TEST(Oracles, TheMiddleOfARoundCourtIsABasin) {
  EXPECT_NEAR(round_court_cos(25, 20, 0), basin_cos(std::atan(20.0 / 25)), 8 * std::numeric_limits<double>::epsilon());
}

TEST(Oracles, TheCanyonsMeansAreTheIntegralsOfItsPoints) {
  const double H = 20, W = 15;
  const int n = 2000;
  double floor = 0, wall = 0;
  for (int k = 0; k < n; ++k) {
    floor += canyon_cos(H, H, W, W * (k + 0.5) / n) / n;
    wall += wall_point_cos(H * (k + 0.5) / n, W) / n;
  }
  // The midpoint rule is off by (interval)²·max|f″|/24 per step, here below 1/n² for both (|f″| < 24 in units of W and H)
  EXPECT_NEAR(floor, canyon_floor_mean(H / W), 1.0 / (n * n) * 24);
  EXPECT_NEAR(wall, canyon_wall_mean(H / W), 1.0 / (n * n) * 24);
}

TEST(Oracles, AgreeWithErellsTableOfCanyonMidPoints) {
  const std::filesystem::path path = scenes::test_data("canyon/erell2012_canyon_midpoint.csv");
  std::ifstream table(path);
  if (!table) GTEST_SKIP() << scenes::absence_of(path);
  int rows = 0;
  for (std::string line; std::getline(table, line);) {
    double h = 0, svf = 0;
    char comma = 0;
    if (!(std::istringstream(line) >> h >> comma >> svf)) continue;
    EXPECT_NEAR(canyon_cos(h, h, 1, 0.5), svf, 0.5e-8 + 0.5e-10) << "h/W = " << h;
    ++rows;
  }
  EXPECT_EQ(rows, 21);
}

}  // namespace
}  // namespace farlod::oracles
