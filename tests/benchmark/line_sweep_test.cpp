// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/line_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/analytic/oracles.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod::benchmark {
namespace {

constexpr float nothing = -std::numeric_limits<float>::infinity();
constexpr std::size_t azimuths = 128;

/// Open ground of so many pixels, around (0, 0).
HeightRaster open_ground(std::size_t columns, std::size_t rows, double pixel_m) {
  const Point2d half_m{0.5 * pixel_m * static_cast<double>(columns), 0.5 * pixel_m * static_cast<double>(rows)};
  return {{{-half_m.x, half_m.y}, pixel_m, columns, rows},
          std::vector<float>(columns * rows, 0.0F),
          std::vector<float>(columns * rows, 0.0F)};
}

void raise_columns(HeightRaster& raster, std::size_t first, std::size_t end, float height_m) {
  for (std::size_t row = 0; row < raster.plan.rows; ++row)
    for (std::size_t column = first; column < end; ++column) raster.surface_m[row * raster.plan.columns + column] = height_m;
}

/// A line meets a wall a pixel too early or too late where it runs along it, and half a pixel beside the middle of the pixel that
/// it stands for. As x/cos²β changes by at most 1/2 of the relative change of the distance, the mean does too.
double rounding_error(double pixel_m, double least_distance_m) { return 0.5 * 1.5 * pixel_m / least_distance_m; }

constexpr double pixel_m = 0.1, wall_m = 20.0;
constexpr std::size_t wall_pixels = 10, street_pixels = 150, length_pixels = 1200;
constexpr double street_m = street_pixels * pixel_m, half_length_m = 0.5 * length_pixels * pixel_m;

class Canyon : public testing::TestWithParam<bool> {
 protected:
  /// The street runs along the raster's columns, or along its rows.
  static HeightRaster raster(bool turned) {
    HeightRaster upright = open_ground(2 * wall_pixels + street_pixels, length_pixels, pixel_m);
    raise_columns(upright, 0, wall_pixels, wall_m);
    raise_columns(upright, wall_pixels + street_pixels, 2 * wall_pixels + street_pixels, wall_m);
    if (!turned) return upright;
    HeightRaster lying = open_ground(length_pixels, 2 * wall_pixels + street_pixels, pixel_m);
    for (std::size_t row = 0; row < lying.plan.rows; ++row)
      for (std::size_t column = 0; column < lying.plan.columns; ++column)
        lying.surface_m[row * lying.plan.columns + column] = upright.surface_m[column * upright.plan.columns + row];
    return lying;
  }
  static double at(const std::vector<float>& svf, bool turned, std::size_t across) {
    const std::size_t along = length_pixels / 2, columns = turned ? length_pixels : 2 * wall_pixels + street_pixels;
    return turned ? svf[(wall_pixels + across) * columns + along] : svf[along * columns + wall_pixels + across];
  }
};

TEST_P(Canyon, HasTheSkyOfTheClosedForm) {
  const std::vector<float> svf = LineSweep(raster(GetParam()), 0.0F).sky_view_factors(azimuths);
  for (const std::size_t across : {40U, 75U, 110U}) {
    const double x = (static_cast<double>(across) + 0.5) * pixel_m;
    // Two walls that end: what one hides, the other does not
    const double expected = oracles::finite_wall_cos(wall_m, x, half_length_m, half_length_m) +
                            oracles::finite_wall_cos(wall_m, street_m - x, half_length_m, half_length_m) - 1.0;
    EXPECT_NEAR(at(svf, GetParam(), across), expected, rounding_error(pixel_m, std::min(x, street_m - x)));
  }
}
INSTANTIATE_TEST_SUITE_P(LineSweep, Canyon, testing::Values(false, true));

TEST(LineSweep, SeesTheTallerWallBehindTheNearerOne) {
  HeightRaster raster = open_ground(400, length_pixels, pixel_m);
  raise_columns(raster, 150, 160, 4.0F);
  raise_columns(raster, 50, 60, 16.0F);
  const std::vector<float> svf = LineSweep(raster, 0.0F).sky_view_factors(azimuths);
  const std::size_t column = 200;
  const double behind_m = (column + 0.5 - 60) * pixel_m;
  EXPECT_NEAR(svf[length_pixels / 2 * 400 + column], oracles::finite_wall_cos(16.0, behind_m, half_length_m, half_length_m),
              rounding_error(pixel_m, behind_m));
}

TEST(LineSweep, SeesAllOfTheSkyOnOpenGround) {
  HeightRaster raster = open_ground(30, 20, 1.0);
  raster.ground_m[5] = raster.surface_m[5] = nothing;
  raise_columns(raster, 12, 13, 1.0F);
  const LineSweep sweep(raster, 1.5F);
  EXPECT_EQ(sweep.receiver_count(), 30U * 20U - 20U - 1U);
  const std::vector<float> svf = sweep.sky_view_factors(16);
  EXPECT_EQ(svf[5], 0.0F);
  EXPECT_EQ(svf[12], 0.0F);
  EXPECT_FLOAT_EQ(svf[40], 1.0F);
}

TEST(Rasterise, HoldsRoofsAndTheGroundBesideThem) {
  scenes::SceneBuilder builder;
  builder.add_box({{3.0, 2.0}, {9.0, 7.0}}, 0.0, 12.0);
  builder.add_box({{5.0, 4.0}, {6.0, 5.0}}, 0.0, 14.0);
  const scenes::TemporaryFolder folder;
  scenes::pack_city(builder.city(), scenes::grid_covering(builder.city(), {}, 20.0, 3), folder.path() / "house.farlod");
  const PackageReader package(folder.path() / "house.farlod");
  const HeightRaster raster = rasterise(package, 1.0);
  const auto height_origin_m = static_cast<float>(package.manifest().height_origin_m);
  const auto pixels_at = [&](float height_m) {
    return std::count(raster.surface_m.begin(), raster.surface_m.end(), height_m - height_origin_m);
  };
  EXPECT_EQ(pixels_at(14.0F), 1);
  EXPECT_EQ(pixels_at(12.0F), 6 * 5 - 1);
  EXPECT_EQ(LineSweep(raster, 1.5F).receiver_count(), raster.surface_m.size() - 30U);
}

}  // namespace
}  // namespace farlod::benchmark
