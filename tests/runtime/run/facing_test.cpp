// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/facing.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace farlod {
namespace {

/// Of a few products and sums of numbers up to 1, and of degrees up to 360.
constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
constexpr double rounding_deg = 360.0 * rounding;

package::Manifest turned_grid() {
  package::Manifest m;
  m.grid.rotation = GridRotation(Angle::degrees(28.3));
  m.convergence = Angle::degrees(0.673);
  return m;
}

TEST(Facing, ComesBackFromItsNormal) {
  const package::Manifest m = turned_grid();
  for (const double azimuth_deg : {0.0, 1.0, 89.5, 180.0, 270.0, 359.0})
    for (const double tilt_deg : {0.5, 45.0, 90.0, 135.0, 179.0}) {
      const Facing facing = facing_of(normal_of({Angle::degrees(azimuth_deg), Angle::degrees(tilt_deg)}, m), m);
      // The sine of half a degree divides the rounding of the normal
      EXPECT_NEAR(std::remainder(facing.azimuth.degrees() - azimuth_deg, 360.0), 0.0, rounding_deg / sin(Angle::degrees(0.5)));
      EXPECT_NEAR(facing.tilt.degrees(), tilt_deg, rounding_deg / sin(Angle::degrees(0.5)));
    }
}

TEST(Facing, OfAWallAlongTheGridIsItsBearingFromTrueNorth) {
  const package::Manifest m = turned_grid();
  EXPECT_NEAR(facing_of({0.0, 1.0, 0.0}, m).azimuth.degrees(), 28.3 + 0.673, rounding_deg);
  EXPECT_NEAR(facing_of({1.0, 0.0, 0.0}, m).azimuth.degrees(), 28.3 + 0.673 + 90.0, rounding_deg);
}

TEST(Facing, WithoutTiltIsStraightUp) {
  const package::Manifest m = turned_grid();
  for (const double azimuth_deg : {0.0, 77.0})
    EXPECT_EQ(normal_of({Angle::degrees(azimuth_deg), {}}, m), (Point3d{0.0, 0.0, 1.0}));
  EXPECT_EQ(facing_of({0.0, 0.0, 1.0}, m).azimuth, Angle{});
}

}  // namespace
}  // namespace farlod
