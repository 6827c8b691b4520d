// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_directions.hpp"

#include <gtest/gtest.h>

#include <limits>

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

TEST(SkyDirections, HorizontalIsThePartitionInTheGridFrame) {
  const GridRotation rotation(Angle::degrees(20));
  const SkyDirections sky(SkyWeight::solid_angle, ray_count, rotation);
  const std::vector<Point3d> expected = SkyPartition(SkyWeight::solid_angle, ray_count).directions();
  ASSERT_EQ(sky.horizontal().size(), expected.size());
  EXPECT_EQ(sky.ray_count(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_EQ(sky.horizontal()[n], rotation.grid_from_city(expected[n]));
}

TEST(SkyDirections, TurningTheGridDoesNotTurnThem) {
  for (const double bearing_deg : {0.0, 33.0, 121.0}) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const SkyDirections turned(SkyWeight::cosine, ray_count, rotation), north(SkyWeight::cosine, ray_count, {});
    for (std::size_t n = 0; n < ray_count; ++n)
      EXPECT_LE(norm(rotation.city_from_grid(turned.horizontal()[n]) - north.horizontal()[n]), rounding);
  }
}

TEST(SkyDirections, AroundANormalEachKeepsItsAngleToIt) {
  const std::vector<Point3d> local = SkyPartition(SkyWeight::cosine, ray_count).directions();
  const SkyDirections sky(SkyWeight::cosine, ray_count, {});
  for (const Point3d& normal : normals) {
    std::size_t n = 0;
    // Rays below the horizon are left out; what is left comes in the order of the partition
    for (const Point3d& d : sky.around(normal)) {
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
  const std::vector<Point3d> tilted = sky.around(normal);
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
        return static_cast<double>(SkyDirections(weight, ray_count, {}).around(normal).size()) / static_cast<double>(ray_count);
      };
      EXPECT_NEAR(share(SkyWeight::cosine), oracles::tilted_cos(tilt.radians()), error) << tilt_deg;
      EXPECT_NEAR(share(SkyWeight::solid_angle), 1.0 - tilt.radians() / std::numbers::pi, error) << tilt_deg;
    }
}

TEST(SkyDirections, AFloorSeesNoSkyAndARoofAll) {
  const SkyDirections sky(SkyWeight::cosine, 145, {});
  EXPECT_TRUE(sky.around({0.0, 0.0, -1.0}).empty());
  EXPECT_EQ(sky.around({0.0, 0.0, 1.0}).size(), 145U);
}

}  // namespace
}  // namespace farlod
