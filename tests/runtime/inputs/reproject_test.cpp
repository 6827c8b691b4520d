// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "inputs/point_reader.hpp"
#include "inputs/reproject_gdal.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod {
namespace {

// The series behind transverse Mercator is good to nanometres near the central meridian; text in WKT is not shorter than that
constexpr double projection_error_m = 1e-6;

TEST(ToProjected, LongitudeComesFirstWhateverTheCrsDeclares) {
  // On the central meridian of zone 32 the easting is the false easting, by definition
  const std::vector<Point2d> points{{9.0, 0.0}, {9.0, 50.0}};
  const std::vector<Point2d> projected = reprojected(points, "EPSG:4258", small_raster().crs_wkt);
  ASSERT_EQ(projected.size(), 2U);
  EXPECT_NEAR(projected[0].x, 500000.0, projection_error_m);
  EXPECT_NEAR(projected[0].y, 0.0, projection_error_m);
  EXPECT_NEAR(projected[1].x, 500000.0, projection_error_m);
  // 0.9996 times the meridian's arc from the equator to 50° on GRS 80, 5540847.041560960 m
  EXPECT_NEAR(projected[1].y, 0.9996 * 5540847.041560960, projection_error_m);
}

TEST(ToProjected, TheSameCrsChangesNothing) {
  const std::vector<Point2d> points{{500100.0, 5600000.0}};
  EXPECT_EQ(reprojected(points, "EPSG:25832", small_raster().crs_wkt), points);
}

TEST(ToProjected, UnknownCrsIsNamed) {
  EXPECT_THAT(scenes::refusal_of<PointsError>([&] { (void)reprojected({}, "EPSG:1", small_raster().crs_wkt); }),
              testing::HasSubstr("EPSG:1"));
}

TEST(ToProjected, APointThatCannotBeProjectedIsNamed) {
  const std::vector<Point2d> points{{9.0, 50.0}, {9.0, 500.0}};
  EXPECT_THAT(scenes::refusal_of<PointsError>([&] { (void)reprojected(points, "EPSG:4258", small_raster().crs_wkt); }),
              testing::HasSubstr("point 2 at (9, 500)"));
}

}  // namespace
}  // namespace farlod
