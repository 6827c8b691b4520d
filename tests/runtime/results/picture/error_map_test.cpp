// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/error_map.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "results/picture/colour_map.hpp"
#include "results/picture/raster_preview.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// 400 × 300 pixels of half a metre, of which the eastern half has the value 1.
GreyMap half_a_map() {
  GreyMap map{{1000.0, 2000.0}, {400, 300, 0.5, std::vector<float>(std::size_t{400} * 300, NAN)}};
  for (std::size_t n = 0; n < map.raster.svf.size(); ++n)
    if (n % 400 >= 200) map.raster.svf[n] = 1.0F;
  return map;
}

/// Too large by .25 in the west, too small by .5 in the east.
const std::vector<VerifiedReceiver> two_receivers{{{1050.0, 1950.0, 3.0}, 0.75F, 0.5F}, {{1150.0, 1900.0, 3.0}, 0.25F, 0.75F}};
constexpr ErrorSummary errors_of_two{2, 0.375, 0.5, 0.5, -0.125, 20000};

TEST(ErrorMap, MarksHaveTheirColoursWhereTheReceiversAre) {
  const scenes::TemporaryFolder folder;
  const auto file = folder.path() / "errors.png";
  write_drawing(draw_error_map(half_a_map(), {}, two_receivers, errors_of_two, {"svf", "EPSG:1"}), file);
  const Picture picture = decoded_png(file);
  const Pixel corner = preview_layout({400, 300}).map;
  const auto at = [&](std::size_t x, std::size_t y) { return picture.at({corner.x + x, corner.y + y}); };
  EXPECT_EQ(at(100, 100), colour_of_error(0.5));  // 50 m east of the corner and 50 m south of it, half a metre a pixel
  EXPECT_EQ(at(300, 200), colour_of_error(-1.0));
  EXPECT_EQ(at(50, 250), (Colour{255, 255, 255}));   // no data
  EXPECT_EQ(at(350, 250), (Colour{232, 232, 232}));  // open sky
  // One points up and one down: six pixels below the middle is the wide side of the first alone
  EXPECT_EQ(at(104, 103), colour_of_error(0.5));
  EXPECT_NE(at(304, 203), colour_of_error(-1.0));
  EXPECT_EQ(at(304, 197), colour_of_error(-1.0));
}

TEST(ErrorMap, LargerErrorsLieOnTop) {
  const scenes::TemporaryFolder folder;
  const auto file = folder.path() / "errors.png";
  const std::vector<VerifiedReceiver> at_one_place{{{1050.0, 1950.0, 0.0}, 1.0F, 0.5F}, {{1050.0, 1950.0, 0.0}, 0.5F, 0.5F}};
  write_drawing(draw_error_map(half_a_map(), {}, at_one_place, {2, 0.25, 0.5, 0.5, 0.25, 20000}, {"svf", ""}), file);
  const Pixel corner = preview_layout({400, 300}).map;
  EXPECT_EQ(decoded_png(file).at({corner.x + 100, corner.y + 100}), colour_of_error(1.0));
}

TEST(ErrorMap, ColoursReachToARoundErrorAboveThe99thPercentile) {
  const auto full = [](double p99) { return error_of_full_colour({1, 0.0, p99, 1.0, 0.0, 1}); };
  EXPECT_DOUBLE_EQ(full(0.0), 0.0001);
  EXPECT_DOUBLE_EQ(full(0.0011), 0.002);
  EXPECT_DOUBLE_EQ(full(0.002), 0.002);
  EXPECT_DOUBLE_EQ(full(0.03), 0.05);
  EXPECT_DOUBLE_EQ(full(0.6), 1.0);
}

TEST(ErrorMap, OfPointsLiesAroundThem) {
  const GreyMap map = map_around(two_receivers, {});
  EXPECT_DOUBLE_EQ(map.north_west_m.x, 1030.0);  // 20 m
  EXPECT_DOUBLE_EQ(map.north_west_m.y, 1970.0);
  EXPECT_DOUBLE_EQ(map.raster.metres_per_pixel, 0.14);
  EXPECT_EQ(map.raster.columns, 1000U);
  EXPECT_NEAR(static_cast<double>(map.raster.rows), 90.0 / 0.14, 1.0);
  EXPECT_DOUBLE_EQ(map_around({}, {{0.0, 0.0}, {10.0, 20.0}}).north_west_m.y, 20.0);
}

}  // namespace
}  // namespace farlod
