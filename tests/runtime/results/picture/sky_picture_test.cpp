// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/sky_picture.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "results/picture/picture_style.hpp"
#include "sun/sun_positions.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

constexpr SkyProjection projections[]{SkyProjection::equidistant, SkyProjection::equal_area, SkyProjection::orthographic};
/// Of a few sines and arcs of doubles.
constexpr double rounding_error = 1e-9;

/// A basin whose horizon is at 30°, but for the east, where a near wall rises to 60°; what is hidden elsewhere is far.
Hemisphere basin_with_a_wall_in_the_east() {
  Hemisphere h{360, 90, std::vector(std::size_t{360} * 90, SkyPart::sky), std::vector<float>(360), 0.0, 0.0F, {}};
  for (std::size_t a = 0; a < 360; ++a) {
    const bool east = 45 <= a && a < 135;
    const std::size_t edge = east ? 60 : 30;
    h.horizon[a] = static_cast<float>(std::tan(static_cast<double>(edge) * rad_per_deg));
    for (std::size_t e = 0; e < edge; ++e) h.parts[a * 90 + e] = east ? SkyPart::near : SkyPart::far;
  }
  h.svf = static_cast<float>(0.75 * std::pow(std::cos(30.0 * rad_per_deg), 2) + 0.25 * std::pow(std::cos(60.0 * rad_per_deg), 2));
  return h;
}

/// The view factor of the pixels that are sky, each weighted by its solid angle and the cosine of its zenith angle.
double svf_of(const Picture& disk, SkyProjection projection) {
  const std::size_t edge = disk.size().width;
  const double pixel = 2.0 / static_cast<double>(edge);
  double sky = 0.0, all = 0.0;
  for (std::size_t y = 0; y < edge; ++y)
    for (std::size_t x = 0; x < edge; ++x) {
      const auto d =
          direction_of({(static_cast<double>(x) + 0.5) * pixel - 1.0, 1.0 - (static_cast<double>(y) + 0.5) * pixel}, projection);
      if (!d) continue;
      const double zenith = d->zenith_angle_deg * rad_per_deg;
      const double solid_angle = projection == SkyProjection::equidistant  ? std::sin(zenith) / std::max(zenith, 1e-3)
                                 : projection == SkyProjection::equal_area ? 1.0
                                                                           : 1.0 / std::cos(zenith);
      const double weight = solid_angle * std::cos(zenith);
      all += weight;
      if (disk.at({x, y}) == colour_of(SkyPart::sky)) sky += weight;
    }
  return sky / all;
}

TEST(SkyPicture, ADirectionComesBackFromItsPlace) {
  for (const SkyProjection projection : projections)
    for (const double azimuth : {1.0, 90.0, 200.0, 359.0})
      for (const double zenith : {1.0, 45.0, 89.0}) {
        const auto back = direction_of(disk_point_of({azimuth, zenith}, projection), projection);
        ASSERT_TRUE(back.has_value());
        EXPECT_NEAR(back->azimuth_deg, azimuth, rounding_error);
        EXPECT_NEAR(back->zenith_angle_deg, zenith, rounding_error);
      }
}

TEST(SkyPicture, NorthIsUpAndEastIsOnTheLeft) {
  for (const SkyProjection projection : projections) {
    const DiskPoint north = disk_point_of({0.0, 90.0}, projection), east = disk_point_of({90.0, 90.0}, projection);
    EXPECT_NEAR(north.v, 1.0, rounding_error);
    EXPECT_NEAR(east.u, -1.0, rounding_error);
  }
}

TEST(SkyPicture, PartsHaveTheirColoursWhereTheyAre) {
  const Picture disk = draw_sky_disk(basin_with_a_wall_in_the_east(), SkyProjection::equidistant, 300);
  EXPECT_EQ(disk.at({150, 150}), colour_of(SkyPart::sky));
  EXPECT_EQ(disk.at({75, 150}), colour_of(SkyPart::near));  // 45° high in the east
  EXPECT_EQ(disk.at({225, 150}), colour_of(SkyPart::sky));  // 45° high in the west
  EXPECT_EQ(disk.at({290, 150}), colour_of(SkyPart::far));
  EXPECT_EQ(disk.at({0, 0}), (Colour{255, 255, 255}));
}

TEST(SkyPicture, WeightedPixelsGiveTheViewFactor) {
  const Hemisphere hemisphere = basin_with_a_wall_in_the_east();
  for (const SkyProjection projection : projections)
    EXPECT_NEAR(svf_of(draw_sky_disk(hemisphere, projection, 400), projection), hemisphere.svf, 0.01);
}

/// The sun's way at 50° N on the longest day of 2026, where clocks show UTC.
SunOfSky longest_day() {
  SunCourse course{"2026-06-21", {}};
  for (const SunDirection& d : sun_course({Angle::degrees(0.0), Angle::degrees(50.0)},
                                          std::chrono::sys_days(std::chrono::year(2026) / std::chrono::June / 21)))
    course.minutes.push_back({d.azimuth.degrees(), 90.0 - d.elevation.degrees()});
  return {{course}, {"Local mean time"}};
}

/// The pixel of a direction in draw_sky's disk, by the definition of the equidistant projection.
Pixel equidistant_pixel(double azimuth_deg, double elevation_deg) {
  const double away = 400.0 * (90.0 - elevation_deg) / 90.0, azimuth = azimuth_deg * rad_per_deg;
  return {static_cast<std::size_t>(56.0 + 400.0 - away * std::sin(azimuth)),
          static_cast<std::size_t>(116.0 + 400.0 - away * std::cos(azimuth))};
}

class SunInThePicture : public testing::Test {
 protected:
  [[nodiscard]] Picture drawn(const std::optional<SunOfSky>& sun) const {
    const auto file = folder_.file("sun.png");
    write_drawing(draw_sky(basin_with_a_wall_in_the_east(), SkyProjection::equidistant, {"svf", ""}, sun), file);
    return decoded_png(file);
  }
  static SunDirection sun_at(int hour) {
    return sun_direction({Angle::degrees(0.0), Angle::degrees(50.0)},
                         std::chrono::sys_days(std::chrono::year(2026) / std::chrono::June / 21) + std::chrono::hours(hour));
  }
  static Pixel pixel_at(int hour) { return equidistant_pixel(sun_at(hour).azimuth.degrees(), sun_at(hour).elevation.degrees()); }

 private:
  scenes::TemporaryFolder folder_;
};

TEST_F(SunInThePicture, HasADotWhereTheSunIsAtEachFullHour) {
  const Picture with = drawn(longest_day()), without = drawn({});
  for (const int hour : {11, 12, 14, 15}) {  // above 30° in the south and the west
    EXPECT_EQ(without.at(pixel_at(hour)), colour_of(SkyPart::sky)) << hour;
    EXPECT_EQ(with.at(pixel_at(hour)), (Colour{178, 24, 43})) << hour;
  }
  EXPECT_EQ(with.at(equidistant_pixel(180.0, 80.0)), colour_of(SkyPart::sky));  // where it never is
}

TEST_F(SunInThePicture, IsPaleWhereGeometryHidesTheSun) {
  const Picture picture = drawn(longest_day());
  // In the morning behind the near wall in the east, in the evening behind what is far
  for (const int hour : {6, 8, 18}) EXPECT_EQ(picture.at(pixel_at(hour)), (Colour{250, 200, 200})) << hour;
}

TEST_F(SunInThePicture, IsNotDrawnBelowTheHorizon) {
  SunOfSky sun = longest_day();
  for (HemisphereDirection& d : sun.courses.front().minutes) d.zenith_angle_deg = 91.0;
  const Picture night = drawn(sun), without = drawn({});
  for (std::size_t y = 116; y < 916; ++y)
    for (std::size_t x = 56; x < 856; ++x) ASSERT_EQ(night.at({x, y}), without.at({x, y})) << x << ", " << y;
}

}  // namespace
}  // namespace farlod
