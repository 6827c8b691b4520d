// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_directions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod {
namespace {

constexpr std::size_t ray_count = 5000;
/// A dozen operations on numbers of at most 1.
constexpr double rounding = 24 * std::numeric_limits<double>::epsilon();

const Point3d normals[] = {normalized(Point3d{0.3, -0.2, 0.9}),
                           normalized(Point3d{-1.0, 0.4, 0.05}),
                           {1.0, 0.0, 0.0},
                           {0.0, -1.0, 0.0},
                           normalized(Point3d{0.1, 0.2, -0.5})};

TEST(SkyDirections, FacingUpIsThePartitionInTheGridFrame) {
  const GridRotation rotation(Angle::degrees(20));
  const SkyDirections sky(SkyWeight::solid_angle, ray_count, rotation);
  const std::vector<Point3d> expected = SkyPartition(SkyWeight::solid_angle, ray_count).directions();
  ASSERT_EQ(sky.facing_up().size(), expected.size());
  EXPECT_EQ(sky.ray_count(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_EQ(sky.facing_up()[n], rotation.grid_from_city(expected[n]));
}

TEST(SkyDirections, TurningTheGridDoesNotTurnThem) {
  for (const double bearing_deg : {0.0, 33.0, 121.0}) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const SkyDirections turned(SkyWeight::cosine, ray_count, rotation), north(SkyWeight::cosine, ray_count, {});
    for (std::size_t n = 0; n < ray_count; ++n)
      EXPECT_LE(norm(rotation.city_from_grid(turned.facing_up()[n]) - north.facing_up()[n]), rounding);
  }
}

TEST(SkyDirections, AroundANormalEachKeepsItsAngleToIt) {
  const std::vector<Point3d> local = SkyPartition(SkyWeight::cosine, ray_count).directions();
  const SkyDirections sky(SkyWeight::cosine, ray_count, {});
  for (const Point3d& normal : normals) {
    std::size_t n = 0;
    // Rays below the horizon are left out; what is left comes in the order of the partition
    for (const Point3d& d : sky.facing(normal)) {
      EXPECT_GT(d.z, 0.0);
      EXPECT_NEAR(norm(d), 1.0, rounding);
      while (n < local.size() && std::abs(local[n].z - dot(d, normal)) > rounding) ++n;
      ASSERT_LT(n, local.size()) << "a direction that is none of the partition's";
      ++n;
    }
  }
}

TEST(SkyDirections, AreTurnedAndNotMirrored) {
  const SkyDirections sky(SkyWeight::cosine, 300, {});
  const std::vector<Point3d> local = SkyPartition(SkyWeight::cosine, 300).directions();
  // Tilted so little that no ray is lost
  const Point3d normal = normalized(Point3d{0.01, 0.02, 1.0});
  const std::vector<Point3d> tilted = sky.facing(normal);
  ASSERT_EQ(tilted.size(), local.size()) << "choose a smaller tilt";
  for (std::size_t n = 2; n < local.size(); ++n) {
    EXPECT_NEAR(dot(tilted[n], tilted[n - 1]), dot(local[n], local[n - 1]), rounding);
    EXPECT_NEAR(dot(cross(tilted[n], tilted[n - 1]), tilted[n - 2]), dot(cross(local[n], local[n - 1]), local[n - 2]), rounding);
  }
}

TEST(SkyDirections, ATiltedPlaneInTheOpenSeesItsShareOfTheSky) {
  for (const double tilt_deg : {1.0, 20.0, 45.0, 90.0, 135.0, 179.0})
    for (const double azimuth_deg : {0.0, 77.0, 200.0}) {
      const Angle tilt = Angle::degrees(tilt_deg), azimuth = Angle::degrees(azimuth_deg);
      const Point3d normal{sin(tilt) * sin(azimuth), sin(tilt) * cos(azimuth), cos(tilt)};
      // The border is the horizon: half an ellipse on the disk, half a great circle on the hemisphere
      const double error = sampling_error(ray_count, std::numbers::pi);
      const auto share = [&](SkyWeight weight) {
        return static_cast<double>(SkyDirections(weight, ray_count, {}).facing(normal).size()) / static_cast<double>(ray_count);
      };
      EXPECT_NEAR(share(SkyWeight::cosine), oracles::tilted_cos(tilt.radians()), error) << tilt_deg;
      EXPECT_NEAR(share(SkyWeight::solid_angle), 1.0 - tilt.radians() / std::numbers::pi, error) << tilt_deg;
    }
}

TEST(SkyDirections, AFloorSeesNoSkyAndARoofAll) {
  const SkyDirections sky(SkyWeight::cosine, 145, {});
  EXPECT_TRUE(sky.facing({0.0, 0.0, -1.0}).empty());
  EXPECT_EQ(sky.facing({0.0, 0.0, 1.0}).size(), 145U);
}

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};

SkyDirections fibonacci(SkyWeight weight, std::size_t rays) { return {weight, rays, {}, DirectionSet::fibonacci}; }

TEST(FibonacciDirections, AreAsManyAsAskedForAndAllAbove) {
  for (const SkyWeight weight : both_weights)
    for (const std::size_t rays : {1U, 2U, 145U, 1000U}) {
      const SkyDirections sky = fibonacci(weight, rays);
      EXPECT_EQ(sky.ray_count(), rays);
      ASSERT_EQ(sky.facing_up().size(), rays);
      for (const Point3d& d : sky.facing_up()) {
        EXPECT_GT(d.z, 0.0);
        EXPECT_NEAR(norm(d), 1.0, rounding);
      }
    }
}

TEST(FibonacciDirections, EachBandHasItsShare) {
  for (const SkyWeight weight : both_weights) {
    const SkyDirections sky = fibonacci(weight, ray_count);
    for (const auto& [low, high] : {std::pair(0.0, 0.1), {0.3, 0.35}, {0.0, 1.0}, {0.97, 1.0}}) {
      const auto inside = [&, from = low, to = high](const Point3d& d) {
        const double share = sky_share_above(weight, d);
        return share >= from && share < to;
      };
      const auto count = std::count_if(sky.facing_up().begin(), sky.facing_up().end(), inside);
      EXPECT_NEAR(static_cast<double>(count), (high - low) * ray_count, 1.0);
    }
  }
}

/// Multiples of the golden ratio, n of them, fill each interval of the circle but for 3 + (1/ln φ + 1/ln 2) ln n (Kuipers &
/// Niederreiter, theorem 3.4 of chapter 2); those of a band are n in a row, and the band itself is off by one.
double most_off(std::size_t n) {
  return 4.0 + (1.0 / std::log(std::numbers::phi) + 1.0 / std::numbers::ln2) * std::log(static_cast<double>(n));
}

TEST(FibonacciDirections, EachSectorOfABandHasItsShare) {
  constexpr std::size_t many = 100000;
  for (const SkyWeight weight : both_weights) {
    const SkyDirections sky = fibonacci(weight, many);
    for (const auto& [low, high] : {std::pair(0.0, 0.2), {0.3, 0.7}, {0.9, 1.0}})
      for (const double sector : {0.01, 0.1, 0.3})
        for (const double begin : {0.0, 0.17, 0.55}) {
          const auto inside = [&, from = low, to = high](const Point3d& d) {
            const double turns = azimuth_of(horizontal(d)).radians() / (2.0 * std::numbers::pi),
                         share = sky_share_above(weight, d);
            return share >= from && share < to && turns >= begin && turns < begin + sector;
          };
          const auto count = std::count_if(sky.facing_up().begin(), sky.facing_up().end(), inside);
          EXPECT_NEAR(static_cast<double>(count), (high - low) * sector * many, most_off(many)) << sector;
        }
  }
}

TEST(FibonacciDirections, TurningTheGridDoesNotTurnThem) {
  const GridRotation rotation(Angle::degrees(33.0));
  const SkyDirections turned(SkyWeight::cosine, 500, rotation, DirectionSet::fibonacci),
      north = fibonacci(SkyWeight::cosine, 500);
  for (std::size_t n = 0; n < 500; ++n)
    EXPECT_LE(norm(rotation.city_from_grid(turned.facing_up()[n]) - north.facing_up()[n]), rounding);
}

TEST(SkyDirections, AStopEndsTheirMaking) {
  std::stop_source stop;
  stop.request_stop();
  for (const DirectionSet set : {DirectionSet::partition, DirectionSet::fibonacci})
    EXPECT_THROW(SkyDirections(SkyWeight::cosine, 1000, {}, set, stop.get_token()), Cancelled);
}

/// Root of the mean square of the errors that some directions make of finite walls, of many heights and at many azimuths.
double error_of_walls(SkyWeight weight, DirectionSet set, std::size_t rays) {
  const SkyDirections sky(weight, rays, {}, set);
  double sum = 0.0;
  int walls = 0;
  for (int n = 0; n < 60; ++n)
    for (const double H : {4.0, 11.0, 30.0}) {
      const double d = 10.0, left = 3.0 + n % 7 * 4.0, right = 50.0 - left, turn = 0.37 * n;
      const auto is_free = [&](const Point3d& s) {
        const double across = s.x * std::cos(turn) + s.y * std::sin(turn), along = s.y * std::cos(turn) - s.x * std::sin(turn);
        if (across <= 0.0 || along * d / across < -left || along * d / across > right) return true;
        return s.z * d / across > H;
      };
      const auto free = std::count_if(sky.facing_up().begin(), sky.facing_up().end(), is_free);
      const double truth = weight == SkyWeight::cosine ? oracles::finite_wall_cos(H, d, left, right)
                                                       : oracles::finite_wall_solid(H, d, left, right);
      sum += std::pow(static_cast<double>(free) / static_cast<double>(rays) - truth, 2);
      ++walls;
    }
  return std::sqrt(sum / walls);
}

TEST(FibonacciDirections, AreNoWorseThanThePartition) {
  for (const SkyWeight weight : both_weights)
    for (const std::size_t rays : {256U, 1000U, 4000U}) {
      const double lattice = error_of_walls(weight, DirectionSet::fibonacci, rays),
                   partition = error_of_walls(weight, DirectionSet::partition, rays);
      EXPECT_LE(lattice, partition) << rays << " rays";
    }
}

}  // namespace
}  // namespace farlod
