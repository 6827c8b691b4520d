// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "base/azimuth.hpp"
#include "package/edge_view.hpp"

namespace farlod {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Point2d unit(double azimuth_rad) { return {std::cos(azimuth_rad), std::sin(azimuth_rad)}; }

TEST(AzimuthBins, HoldTheAzimuthsBetweenTheirBorders) {
  for (const std::uint32_t count : {1U, 3U, 64U, 257U}) {
    const AzimuthBins bins{count};
    for (std::uint32_t k = 0; k < count; ++k)
      for (const double within : {0.01, 0.5, 0.99}) EXPECT_EQ(bins.bin_of(unit((k + within) * bins.width_rad())), k);
  }
}

TEST(AzimuthBins, BeginAtTheXAxisAndRunCounterClockwise) {
  const AzimuthBins bins{4};
  EXPECT_EQ(bins.bin_of({1.0, 0.0}), 0U);
  EXPECT_EQ(bins.bin_of({1.0, 1.0}), 0U);
  EXPECT_EQ(bins.bin_of({-1.0, 1.0}), 1U);
  EXPECT_EQ(bins.bin_of({-1.0, -1.0}), 2U);
  EXPECT_EQ(bins.bin_of({1.0, -1.0}), 3U);
}

TEST(AzimuthBins, WrapAnyNumberOfTurns) {
  const AzimuthBins bins{64};
  for (std::int64_t turn = -3; turn <= 3; ++turn)
    for (const std::int64_t bin : {0, 1, 31, 63}) EXPECT_EQ(bins.wrapped(bin + 64 * turn), bin);
}

TEST(PseudoAngle, CountsTurns) {
  EXPECT_EQ(pseudo_angle({7.0, 0.0}), 0.0);
  EXPECT_EQ(pseudo_angle({0.0, 0.1}), 0.25);
  EXPECT_EQ(pseudo_angle({-3.0, 0.0}), 0.5);
  EXPECT_EQ(pseudo_angle({0.0, -2.0}), 0.75);
  EXPECT_EQ(pseudo_angle({2.0, 2.0}), 0.125);
  EXPECT_EQ(pseudo_angle({2.0, -2.0}), 0.875);
}

TEST(PseudoAngle, GrowsByAnEighthToAQuarterOfATurnPerRadian) {
  constexpr int steps = 5000;
  constexpr double step_rad = 2.0 * pi / steps;
  // Each of the two values is the sum of a few roundings, none of a number above 1
  constexpr double rounding = 8 * epsilon;
  for (int n = 0; n + 1 < steps; ++n) {
    const double growth = pseudo_angle(unit((n + 1) * step_rad)) - pseudo_angle(unit(n * step_rad));
    EXPECT_GE(growth, 0.125 * step_rad - rounding) << n;
    EXPECT_LE(growth, 0.25 * step_rad + rounding) << n;
  }
}

TEST(PseudoAngle, DoesNotDependOnTheLength) {
  for (const double length : {1e-6, 1.0, 3e5})
    EXPECT_NEAR(pseudo_angle(length * Point2d{-0.6, 0.8}), pseudo_angle({-0.6, 0.8}), 4 * epsilon);
}

TEST(EdgeView, TurnsCounterClockwiseForPositive) {
  EXPECT_GT((EdgeView{{10.0, -1.0, 5.0}, {10.0, 1.0, 5.0}}.turn()), 0.0);
  EXPECT_LT((EdgeView{{10.0, 1.0, 5.0}, {10.0, -1.0, 5.0}}.turn()), 0.0);
  EXPECT_EQ((EdgeView{{10.0, 5.0, 5.0}, {20.0, 10.0, 7.0}}.turn()), 0.0);
}

TEST(SlopePlane, PassesThroughTheEyeAndEachPlaceOfTheEdge) {
  std::mt19937_64 random(20120901);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int n = 0; n < 1000; ++n) {
    const auto corner = [&] { return Point3d{between(-90, 90), between(-90, 90), between(-30, 200)}; };
    const EdgeView edge{corner(), corner()};
    const SlopePlane plane = edge.plane();
    // A determinant of lengths below 128 and 200 over one of lengths below 128, each with a handful of roundings
    const double rounding = 16 * 128 * 256 * epsilon / std::abs(edge.turn());
    for (const double t : {0.0, 0.3, 1.0}) {
      const Point3d p = (1.0 - t) * edge.a + t * edge.b;
      const double distance_m = norm(horizontal(p));
      if (distance_m < 1.0) continue;
      const Point2d u = (1.0 / distance_m) * horizontal(p);
      EXPECT_NEAR(plane.slope(u), p.z / distance_m, rounding * (1.0 + std::abs(p.z / distance_m))) << n << ", " << t;
    }
  }
}

TEST(SlopePlane, DoesNotDependOnTheOrderOfTheEnds) {
  const EdgeView edge{{40.0, -3.0, 12.0}, {31.0, 26.0, 20.0}}, other{edge.b, edge.a};
  EXPECT_DOUBLE_EQ(edge.plane().along_x, other.plane().along_x);
  EXPECT_DOUBLE_EQ(edge.plane().along_y, other.plane().along_y);
}

}  // namespace
}  // namespace farlod
