// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/placed_on_globe.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace farlod {
namespace {

/// What sums of squares of coordinates of some metres leave of a double.
constexpr double rounding = 1e-12;

Point3d axis_of(const EcefFromLocal& m, std::size_t n) { return {m[4 * n], m[4 * n + 1], m[4 * n + 2]}; }

void expect_similar(const EcefFromLocal& m, double scale) {
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(norm(axis_of(m, n)), scale, rounding) << n;
    EXPECT_NEAR(dot(axis_of(m, n), axis_of(m, (n + 1) % 3)), 0.0, rounding) << n;
  }
  EXPECT_GT(dot(cross(axis_of(m, 0), axis_of(m, 1)), axis_of(m, 2)), 0.0) << "a mirror image";
}

TEST(PlacedOnGlobe, AMapIsTurnedAndEnlargedAlike) {
  const EcefFromLocal m = similar_frame({0.0, 1.0002, 0.0}, {-1.0002, 0.0, 0.0}, {7.0, 8.0, 9.0});
  expect_similar(m, 1.0002);
  EXPECT_NEAR(m[1], 1.0002, rounding);
  EXPECT_NEAR(m[4], -1.0002, rounding);
  EXPECT_EQ((Point3d{m[12], m[13], m[14]}), (Point3d{7.0, 8.0, 9.0}));
}

TEST(PlacedOnGlobe, AMapThatIsSkewIsMetHalfWay) {
  const Angle skew = Angle::degrees(1.0);
  const EcefFromLocal m = similar_frame({4.0, 0.0, 0.0}, {sin(skew), cos(skew), 0.0}, {});
  expect_similar(m, 2.0);
  EXPECT_NEAR(std::atan2(m[1], m[0]), -Angle::degrees(0.5).radians(), rounding);
}

#ifdef FARLOD_WITH_GDAL
TEST(PlacedOnGlobe, UtmIsWhereItShouldBe) {
  PackageDescription description;
  description.crs_wkt = "EPSG:32631";
  ViewFrame frame;
  // On the equator and the central meridian of 3° east, where the scale is 0.9996: a metre of the map is 1/0.9996 m long
  frame.origin_projected = {500000.0, 0.0, 20.0};
  const EcefFromLocal m = placed_on_globe(description, frame);
  // To a micrometre a metre, since the map is a chord of 200 m of a curved Earth
  const double scale = 1.0 / 0.9996;
  EXPECT_NEAR(norm(axis_of(m, 0)), scale, 1e-5);
  EXPECT_NEAR(norm(axis_of(m, 2)), norm(axis_of(m, 0)), rounding);
  const Angle east = Angle::degrees(3.0);
  EXPECT_NEAR(m[12], (6378137.0 + 20.0) * cos(east), 1e-3);
  EXPECT_NEAR(m[13], (6378137.0 + 20.0) * sin(east), 1e-3);
  EXPECT_NEAR(m[14], 0.0, 1e-3);
  EXPECT_NEAR(m[8], scale * cos(east), 1e-5) << "up";
  EXPECT_NEAR(m[6], scale, 1e-5) << "north";
}
#endif

}  // namespace
}  // namespace farlod
