// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/doubtful_surface.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

namespace farlod::plausibility {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

using HeightAt = std::function<double(Point2d)>;

TerrainRaster raster_of(const HeightAt& height_m, double pixel_m = 1.0) {
  TerrainRaster raster;
  raster.columns = 60;
  raster.rows = 50;
  raster.step_m = {pixel_m, pixel_m};
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column)
      raster.height_m.emplace_back(static_cast<float>(height_m(raster.node(column, row))));
  return raster;
}

std::string doubt_about(const HeightAt& height_m, double pixel_m = 1.0) {
  return doubt_about_surface(shape_of(raster_of(height_m, pixel_m))).value_or("no doubt");
}

/// Houses of 8 m, 10 m wide, every 25 m on ground that climbs.
double town_m(Point2d p) {
  const bool is_house = std::fmod(p.x, 25.0) > 15.0 && std::fmod(p.y, 25.0) > 15.0;
  return 10.0 + 0.05 * p.x + (is_house ? 8.0 : 0.0);
}

TEST(DoubtfulSurface, CentimetresAreToldByTheirSlopes) {
  EXPECT_EQ(doubt_about(town_m), "no doubt");
  EXPECT_THAT(
      doubt_about([](Point2d p) { return 100.0 * town_m(p); }),
      AllOf(StartsWith("its heights, from 1000 m to 2045 m, climb or fall by 20 m"), HasSubstr("gdal_edit.py -scale 0.01")));
  EXPECT_EQ(doubt_about([](Point2d p) { return p.x < 30.0 ? 0.0 : 400.0; }), "no doubt") << "a row of towers";
  EXPECT_EQ(doubt_about([](Point2d p) { return 2.0 * p.x + 1.5 * p.y; }, 10.0), "no doubt") << "a mountain";
}

TEST(DoubtfulSurface, NoiseOfSmallPixelsIsNoRelief) {
  const auto noisy_m = [](Point2d p) {
    const bool is_mast = p.x < 0.1 && p.y < 0.1;
    return is_mast ? 150.0 : 3.0 * std::sin(1e4 * p.x + 3e4 * p.y);
  };
  EXPECT_EQ(doubt_about(noisy_m, 0.2), "no doubt");
}

TEST(DoubtfulSurface, SharesAreToldByTheirFlatness) {
  EXPECT_THAT(doubt_about([](Point2d p) { return 0.5 + 0.5 * std::sin(p.x); }),
              AllOf(StartsWith("its heights lie between 0.00 m and 1.00 m"), HasSubstr("a share from 0 to 1")));
  EXPECT_EQ(doubt_about([](Point2d p) { return 0.03 * p.x; }), "no doubt");
  EXPECT_EQ(doubt_about([](Point2d) { return 5.0; }), "no doubt") << "a level plane, as for a check";
}

TEST(DoubtfulSurface, ClassesAreToldByWholeNumbers) {
  const auto classes = [](Point2d p) { return 1.0 + std::fmod(std::floor(p.x / 7.0) + std::floor(p.y / 9.0), 7.0); };
  EXPECT_THAT(doubt_about(classes), StartsWith("it holds whole numbers from 1 to 7 alone"));
  EXPECT_EQ(doubt_about([&](Point2d p) { return classes(p) + 0.1; }), "no doubt");
  EXPECT_EQ(doubt_about([](Point2d p) { return p.x < 20.0 ? 0.0 : p.y < 20.0 ? 4.0 : 6.0; }), "no doubt") << "a plan of blocks";
}

TEST(DoubtfulSurface, PointsAreJudgedAsPixelsAre) {
  std::vector<Point3d> points;
  const auto doubt_of = [&](double unit) {
    points.clear();
    for (int row = 0; row < 50; ++row)
      for (int column = 0; column < 60; ++column)
        points.push_back({1.0 * column, 1.0 * row, unit * town_m({1.0 * column, 1.0 * row})});
    return doubt_about_surface(shape_of(points));
  };
  EXPECT_FALSE(doubt_of(1.0));
  EXPECT_TRUE(doubt_of(100.0));
  EXPECT_EQ(shape_of(points).highest->z, shape_of(points).high_m);
}

TEST(DoubtfulSurface, AFewPointsAreNot) {
  const std::vector<Point3d> few{{0.0, 0.0, 0.1}, {5.0, 0.0, 0.4}, {5.0, 5.0, 0.9}};
  EXPECT_FALSE(doubt_about_surface(shape_of(few)));
}

}  // namespace
}  // namespace farlod::plausibility
