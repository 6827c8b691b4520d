// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/azimuth_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "farlod/angle.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"

namespace farlod {
namespace {

/// Azimuths of the city frame in turns, ascending.
std::vector<double> city_turns(const AzimuthSampling& ring, const GridRotation& rotation) {
  std::vector<double> turns;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d u = rotation.city_from_grid(Point2d{ring.cosine()[k], ring.sine()[k]});
    const double t = std::atan2(u.y, u.x) / (2.0 * std::numbers::pi);
    turns.push_back(t < 0.0 ? t + 1.0 : t);
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

TEST(AzimuthSampling, EvenRingsDoNotTurnWithTheGrid) {
  for (const std::size_t count : {1U, 7U, 64U, 256U})
    for (const double bearing_deg : {0.0, 17.0, 45.0, -123.4, 90.0}) {
      const GridRotation rotation(Angle::degrees(bearing_deg));
      const std::vector<double> turns = city_turns(AzimuthSampling::even(count, rotation), rotation);
      ASSERT_EQ(turns.size(), count);
      for (std::size_t k = 0; k < count; ++k)
        EXPECT_NEAR(turns[k], (static_cast<double>(k) + 0.5) / static_cast<double>(count), 2.0 * float_rounding) << bearing_deg;
    }
}

/// In turns, from 0 to less than 1.
double azimuth(const AzimuthSampling& ring, std::size_t k) {
  const double turns = std::atan2(double{ring.sine()[k]}, double{ring.cosine()[k]}) / (2.0 * std::numbers::pi);
  return turns < 0.0 ? turns + 1.0 : turns;
}

void expect_consistent(const AzimuthSampling& ring) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    EXPECT_NEAR(std::hypot(ring.cosine()[k], ring.sine()[k]), 1.0, 4.0 * float_rounding);
    if (k == 0) continue;
    EXPECT_GE(azimuth(ring, k), azimuth(ring, k - 1) - azimuth_rounding_rad) << k;
  }
}

TEST(AzimuthSampling, AscendsOnceAround) {
  for (const std::size_t count : {1U, 3U, 100U, 256U})
    expect_consistent(AzimuthSampling::even(count, GridRotation(Angle::degrees(3.0))));
  for (const std::size_t count : {1U, 10U, 1000U})
    expect_consistent(AzimuthSampling(SkyPartition(SkyWeight::cosine, count).directions()));
}

TEST(AzimuthSampling, OfDirectionsSaysWhichIsWhere) {
  std::vector<Point3d> directions = SkyPartition(SkyWeight::solid_angle, 500).directions();
  directions.push_back({1.0, 0.0, 0.0});
  directions.push_back({std::cos(1e-12), -std::sin(1e-12), 0.0});  // rounds to a whole turn
  const AzimuthSampling ring = AzimuthSampling(directions);
  ASSERT_EQ(ring.size(), directions.size());
  std::vector<std::uint32_t> places(ring.order().begin(), ring.order().end());
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point3d& d = directions[places[k]];
    const double across = std::hypot(d.x, d.y);
    EXPECT_NEAR(ring.cosine()[k], d.x / across, float_rounding);
    EXPECT_NEAR(ring.sine()[k], d.y / across, float_rounding);
  }
  std::sort(places.begin(), places.end());
  for (std::uint32_t n = 0; n < places.size(); ++n) EXPECT_EQ(places[n], n);
}

TEST(AzimuthSampling, StraightUpGetsAnAzimuthToo) {
  const std::vector<Point3d> up{{0.0, 0.0, 1.0}};
  const AzimuthSampling ring = AzimuthSampling(up);
  ASSERT_EQ(ring.size(), 1U);
  expect_consistent(ring);
}

}  // namespace
}  // namespace farlod
