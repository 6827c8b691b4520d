// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "results/picture/colour_map.hpp"
#include "results/picture/raster_preview.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// Relative luminance of an sRGB colour (IEC 61966-2-1).
double luminance(Colour colour) {
  const auto linear = [](std::uint8_t c) {
    const double v = c / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
}

PreviewRaster fit_to_screen(const WholeRaster& raster) {
  ScreenFit fit(raster);
  for (const RasterTile& tile : tiles_of(raster)) fit.add(tile);
  return fit.preview();
}

WholeRaster raster_of(std::size_t columns, std::size_t rows, float svf) {
  WholeRaster raster;
  raster.columns = columns;
  raster.rows = rows;
  raster.svf.assign(columns * rows, svf);
  raster.bands = svf_bands("svf", RasterBands::svf);
  return raster;
}

TEST(ColourMap, LuminanceRisesWithTheShare) {
  // A hundredth is the finest step that a preview is read for
  for (int n = 1; n <= 100; ++n) EXPECT_GT(luminance(colour_of_svf(n / 100.0)), luminance(colour_of_svf((n - 1) / 100.0))) << n;
}

TEST(ColourMap, ValuesOutsideTakeTheNearerEnd) {
  EXPECT_EQ(colour_of_svf(-0.5), colour_of_svf(0.0));
  EXPECT_EQ(colour_of_svf(1.5), colour_of_svf(1.0));
}

TEST(ColourMap, HasNotTheGreyOfNoData) {
  for (int n = 0; n <= 1000; ++n) EXPECT_NE(colour_of_svf(n / 1000.0), nodata_colour);
}

TEST(PreviewRaster, LargeRastersAreAveraged) {
  WholeRaster raster = raster_of(4001, 4, 0.25F);
  raster.step_m = 2.0;
  for (std::size_t n = 0; n < raster.svf.size(); n += 2) raster.svf[n] = 0.75F;
  const PreviewRaster fitted = fit_to_screen(raster);
  EXPECT_EQ(fitted.columns, 1334U);  // 4001 pixels by three
  EXPECT_EQ(fitted.rows, 2U);
  EXPECT_EQ(fitted.metres_per_pixel, 6.0);
  EXPECT_FLOAT_EQ(fitted.svf[0], (5 * 0.75F + 4 * 0.25F) / 9);
  EXPECT_FLOAT_EQ(fitted.svf[1], (4 * 0.75F + 5 * 0.25F) / 9);
}

TEST(PreviewRaster, MostOfASquareDecidesWhetherItHasAnAnswer) {
  WholeRaster raster = raster_of(4000, 2, 0.5F);
  for (const std::size_t n : {0U, 1U, 4000U, 2U, 3U}) raster.svf[n] = std::numeric_limits<float>::quiet_NaN();
  const PreviewRaster fitted = fit_to_screen(raster);
  EXPECT_TRUE(std::isnan(fitted.svf[0]));  // three of four have none
  EXPECT_EQ(fitted.svf[1], 0.5F);          // two of four
}

TEST(PreviewRaster, SmallRastersAreEnlarged) {
  const PreviewRaster fitted = fit_to_screen(small_raster());
  EXPECT_EQ(fitted.columns, 1000U);
  EXPECT_EQ(fitted.rows, 600U);
  EXPECT_EQ(fitted.metres_per_pixel, 0.01);
  EXPECT_EQ(fitted.svf[2 * 200], 0.1F);
  EXPECT_EQ(fitted.svf[599 * 1000 + 999], 0.33333334F);
}

TEST(PreviewLayout, HoldsAllItsParts) {
  for (const PixelSize map : {PixelSize{1, 1}, PixelSize{1000, 1}, PixelSize{1, 2000}, PixelSize{2000, 2000}}) {
    const PreviewLayout layout = preview_layout(map);
    EXPECT_LT(layout.map.x + map.width, layout.colour_bar.x);
    EXPECT_LT(layout.map.y + map.height, layout.footer.y);
    EXPECT_LT(layout.colour_bar.y + layout.colour_bar_size.height, layout.footer.y);
    EXPECT_LT(layout.colour_bar.x + layout.colour_bar_size.width, layout.picture.width);
    EXPECT_LT(layout.footer.y, layout.picture.height);
  }
}

TEST(Preview, DecodesToTheStatedSizeAndColours) {
  const scenes::TemporaryFolder folder;
  write_whole<PreviewWriter>(small_raster(), folder.file("a.png"));
  EXPECT_THAT(folder.names(), testing::ElementsAre("a.png"));
  const Picture picture = decoded_png(folder.file("a.png"));
  const PreviewLayout layout = preview_layout({1000, 600});
  EXPECT_EQ(picture.size(), layout.picture);
  const auto middle_of = [&](std::size_t column, std::size_t row) {
    return picture.at({layout.map.x + column * 200 + 100, layout.map.y + row * 200 + 100});
  };
  EXPECT_EQ(middle_of(0, 0), colour_of_svf(1.0));
  EXPECT_EQ(middle_of(1, 0), nodata_colour);
  EXPECT_EQ(middle_of(0, 1), colour_of_svf(0.0));
  EXPECT_EQ(middle_of(2, 2), nodata_colour);
  EXPECT_EQ(picture.at(layout.colour_bar), colour_of_svf(1.0));
}

/// Ground that is lit changes a colour, level ground does not, and the grey of no data stays as it is.
TEST(Preview, LightChangesTheColoursOfSlopes) {
  const PreviewRaster raster{2, 2, 1.0, {0.5F, 0.5F, 0.5F, std::numeric_limits<float>::quiet_NaN()}};
  WholeRaster frame = raster_of(2, 2, 0.5F);
  const scenes::TemporaryFolder folder;
  write_drawing(draw_preview(raster, frame, {{}, {1.0F, 0.8F, 1.2F, 0.8F}}), folder.file("a.png"));
  const Picture picture = decoded_png(folder.file("a.png"));
  const Pixel map = preview_layout({2, 2}).map;
  EXPECT_EQ(picture.at(map), colour_of_svf(0.5));
  EXPECT_LT(luminance(picture.at({map.x + 1, map.y})), luminance(colour_of_svf(0.5)));
  EXPECT_GT(luminance(picture.at({map.x, map.y + 1})), luminance(colour_of_svf(0.5)));
  EXPECT_EQ(picture.at({map.x + 1, map.y + 1}), nodata_colour);
}

TEST(Preview, OutlinesAreDarkLinesOfTheMap) {
  PreviewRaster raster{100, 100, 1.0, std::vector<float>(10'000, 1.0F)};
  const scenes::TemporaryFolder folder;
  write_drawing(draw_preview(raster, raster_of(100, 100, 1.0F), {{{{20.0, 50.5}, {80.0, 50.5}}}, {}}), folder.file("a.png"));
  const Picture picture = decoded_png(folder.file("a.png"));
  const Pixel map = preview_layout({100, 100}).map;
  EXPECT_LT(luminance(picture.at({map.x + 50, map.y + 50})), 0.4 * luminance(colour_of_svf(1.0)));
  EXPECT_EQ(picture.at({map.x + 50, map.y + 52}), colour_of_svf(1.0));
  EXPECT_EQ(picture.at({map.x + 10, map.y + 50}), colour_of_svf(1.0));
}

TEST(ScaleBar, IsRoundAndAsLongAsItMayBe) {
  EXPECT_EQ(round_length_m(199.0), 100.0);
  EXPECT_EQ(round_length_m(200.0), 200.0);
  EXPECT_EQ(round_length_m(9.9), 5.0);
  EXPECT_EQ(round_length_m(1.0), 1.0);
  EXPECT_EQ(round_length_m(0.3), 0.2);
}

}  // namespace
}  // namespace farlod
