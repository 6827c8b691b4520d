// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "results/picture/picture.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/picture/value_scale.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// Relative luminance of a colour.
double luminance(Colour colour) {
  return 0.2126 * linear_channel(colour.red) + 0.7152 * linear_channel(colour.green) + 0.0722 * linear_channel(colour.blue);
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
  EXPECT_FLOAT_EQ(fitted.values[0], (5 * 0.75F + 4 * 0.25F) / 9);
  EXPECT_FLOAT_EQ(fitted.values[1], (4 * 0.75F + 5 * 0.25F) / 9);
}

TEST(PreviewRaster, MostOfASquareDecidesWhetherItHasAnAnswer) {
  WholeRaster raster = raster_of(4000, 2, 0.5F);
  for (const std::size_t n : {0U, 1U, 4000U, 2U, 3U}) raster.svf[n] = std::numeric_limits<float>::quiet_NaN();
  const PreviewRaster fitted = fit_to_screen(raster);
  EXPECT_TRUE(std::isnan(fitted.values[0]));  // three of four have none
  EXPECT_EQ(fitted.values[1], 0.5F);          // two of four
}

TEST(PreviewRaster, SmallRastersAreEnlarged) {
  const PreviewRaster fitted = fit_to_screen(small_raster());
  EXPECT_EQ(fitted.columns, 1000U);
  EXPECT_EQ(fitted.rows, 600U);
  EXPECT_EQ(fitted.metres_per_pixel, 0.01);
  EXPECT_EQ(fitted.values[2 * 200], 0.1F);
  EXPECT_EQ(fitted.values[599 * 1000 + 999], 0.33333334F);
}

TEST(Preview, DecodesToTheStatedSizeAndColours) {
  const scenes::TemporaryFolder folder;
  write_whole<made<PreviewWriter>>(small_raster(), folder.file("a.png"));
  EXPECT_THAT(folder.names(), testing::ElementsAre("a.png"));
  const Picture picture = decoded_png(folder.file("a.png"));
  const PreviewLayout layout = preview_layout({1000, 600});
  EXPECT_EQ(picture.size(), layout.picture);
  const auto middle_of = [&](std::size_t column, std::size_t row) {
    return picture.at({layout.map.x + column * 200 + 100, layout.map.y + row * 200 + 100});
  };
  EXPECT_EQ(middle_of(0, 0), colour_of_svf(1.0));
  EXPECT_EQ(middle_of(1, 0), no_value_grey);
  EXPECT_EQ(middle_of(0, 1), colour_of_svf(0.0));
  EXPECT_EQ(middle_of(2, 2), no_value_grey);
  EXPECT_EQ(picture.at(layout.colour_bar), colour_of_svf(1.0));
}

constexpr float none = std::numeric_limits<float>::quiet_NaN();

TEST(Preview, LightChangesTheGreyOfGroundAndNoColour) {
  const PreviewRaster raster{2, 2, 1.0, {0.5F, none, none, none}};
  const Picture picture =
      drawn(draw_preview(raster, raster_of(2, 2, 0.5F), {{}, {0.8F, 0.8F, 1.2F, 0.8F}, {false, false, false, true}}));
  const Pixel map = preview_layout({2, 2}).map;
  EXPECT_EQ(picture.at(map), colour_of_svf(0.5));
  EXPECT_LT(luminance(picture.at({map.x + 1, map.y})), luminance(no_value_grey));
  EXPECT_GT(luminance(picture.at({map.x, map.y + 1})), luminance(no_value_grey));
  EXPECT_EQ(picture.at({map.x + 1, map.y + 1}), covered_grey);
}

/// Relative luminances of two greys that are told apart beside each other (WCAG 2.1 asks for 1.3 to 3 of what is read).
constexpr double least_contrast = 1.3;

TEST(Preview, GreysOfBuildingsAndOfNoDataAreToldApart) {
  const auto contrast = [](Colour light, Colour dark) { return (luminance(light) + 0.05) / (luminance(dark) + 0.05); };
  EXPECT_GT(contrast(no_value_grey, covered_grey), least_contrast);
  // Where the ground is as dark as shading_of() makes it
  const PreviewRaster raster{2, 1, 1.0, {none, none}};
  const Picture picture = drawn(draw_preview(raster, raster_of(2, 1, none), {{}, {0.6F, 1.0F}, {false, true}}));
  const Pixel map = preview_layout({2, 1}).map;
  EXPECT_GT(contrast(picture.at(map), picture.at({map.x + 1, map.y})), 1.0);
}

/// The words of a drawing.
std::vector<std::string> words_in(const Drawing& drawing) {
  std::vector<std::string> words;
  for (const auto& shape : drawing.shapes)
    if (const auto* text = std::get_if<Text>(&shape)) words.push_back(text->words);
  return words;
}

TEST(Preview, BuildingsReachToTheEdgesOfTheirPixels) {
  std::vector<bool> one(35), wide(35);
  one[2 * 7 + 1] = true;  // of 7 × 5
  for (const std::size_t row : {1U, 2U, 3U})
    for (const std::size_t column : {0U, 1U, 2U}) wide[row * 7 + column] = true;
  EXPECT_EQ(widened(one, 7, 1), wide);
  EXPECT_EQ(widened(one, 7, 9), std::vector<bool>(35, true));
  EXPECT_TRUE(widened({}, 7, 1).empty());
}

TEST(Preview, TheLegendNamesTheGreysThatThereAre) {
  const auto words = [](std::vector<float> values, const PlanBackground& background) {
    return words_in(draw_preview({2, 1, 1.0, std::move(values)}, raster_of(2, 1, 0.5F), background));
  };
  using testing::Contains, testing::Not;
  EXPECT_THAT(words({none, none}, {{}, {}, {true, false}}), testing::IsSupersetOf({"buildings", "no data"}));
  EXPECT_THAT(words({0.5F, none}, {{}, {}, {true, true}}), Not(Contains("no data")));
  EXPECT_THAT(words({0.5F, none}, {}), Not(Contains("buildings")));
  const auto lit_ground = testing::StartsWith("Ground without data lit");
  EXPECT_THAT(words({0.5F, none}, {{}, {1.0F, 0.8F}, {false, false}}), Contains(lit_ground));
  EXPECT_THAT(words({0.5F, none}, {{}, {0.8F, 1.0F}, {false, false}}), Not(Contains(lit_ground)));
  WholeRaster near_buildings = raster_of(2, 1, 0.5F);
  near_buildings.why_no_value = "not within 3 m";
  EXPECT_THAT(words_in(draw_preview({2, 1, 1.0, {0.5F, none}}, near_buildings, {})),
              testing::AllOf(Contains("not within 3 m"), Not(Contains("no data"))));
  const auto none_at_all = words({0.5F, 0.5F}, {});
  EXPECT_THAT(none_at_all, Not(testing::AnyOf(Contains("no data"), Contains("buildings"))));
}

TEST(Preview, ShowsTheDrawnBandOnItsOwnScale) {
  WholeRaster raster = raster_of(2, 1, 0.25F);
  raster.bands.push_back({"sunlit_h", "h", "hours"});
  raster.drawn_band = 1;
  raster.conditions = "2026-06-21, 1.5 m above the ground";
  ScreenFit fit(raster);
  RasterTile tile({0, 0}, RasterBands::svf, 1);
  tile.svf[0] = tile.svf[1] = 0.25F;
  tile.further[0][0] = 4.0F;
  tile.further[0][1] = 7.93F;
  fit.add(tile);
  const PreviewRaster preview = fit.preview();
  EXPECT_EQ(preview.values.front(), 4.0F);
  const Drawing drawing = draw_preview(preview, raster);
  EXPECT_THAT(words_in(drawing),
              testing::IsSupersetOf({"Sunshine, were the sky clear (sunlit_h)",
                                     "Hours. 2026-06-21, 1.5 m above the ground. Pixels of 1 m", "h", "0", "2", "4", "6"}));
  const Picture picture = drawn(drawing);
  const Pixel map = preview_layout({1000, 500}).map;
  // The scale ends at 8 h
  EXPECT_EQ(picture.at({map.x + 100, map.y + 100}), colour_of_svf(0.5));
  EXPECT_EQ(picture.at({map.x + 900, map.y + 100}), colour_of_svf(static_cast<double>(7.93F) / 8.0));
}

TEST(ValueScale, SharesEndAtOneAndOtherValuesAtTheirGreatest) {
  EXPECT_EQ(scale_of({"svf_total", "1", ""}, 0.3).end, 1.0);
  EXPECT_EQ(scale_of({"svf_total", "1", ""}, 0.3).title, "Sky view factor with trees (svf_total)");
  EXPECT_EQ(scale_of({"svfN", "1", ""}, 0.3).title, "svfN");
  EXPECT_EQ(scale_of({"view_building", "1", ""}, 0.0312).end, 0.032) << "one building fills little of most views";
  EXPECT_EQ(scale_of({"irradiation", "kW h m-2", ""}, 1234.5).end, 1300.0);
  EXPECT_EQ(scale_of({"irradiation", "kW h m-2", ""}, 1300.0).end, 1300.0);
  EXPECT_EQ(scale_of({"irradiation", "kW h m-2", ""}, 1234.5).unit, "kWh/m²");
  EXPECT_EQ(scale_of({"sunlit_total_h", "h", ""}, 9.0).title, "Sunshine with trees, were the sky clear (sunlit_total_h)");
  EXPECT_EQ(scale_of({"sunlit_h", "h", ""}, 0.0).end, 1.0);
}

TEST(ValueScale, TitlesSayNoWordTwice) {
  EXPECT_EQ(scale_of({"irradiation", "kW h m-2", ""}, 1.0).title, "Irradiation");
  EXPECT_EQ(scale_of({"sky_component", "1", ""}, 1.0).title, "Sky component");
  EXPECT_EQ(scale_of({"irradiance", "W m-2", ""}, 1.0).title, "Mean irradiance (irradiance)");
}

/// It was yellow in the shade, and dark in the sun.
TEST(ValueScale, ShadeIsDark) {
  for (const char* shade : {"shade", "shade_2026-06-21T12:00"}) {
    const ValueScale scale = scale_of({shade, "1", ""}, 1.0);
    EXPECT_EQ(scale.colour_of(1.0), colour_of_svf(0.0));
    EXPECT_EQ(scale.colour_of(0.25), colour_of_svf(0.75));
  }
  WholeRaster raster = raster_of(2, 1, 1.0F);
  raster.bands[0] = {"shade", "1", ""};
  const PreviewLayout layout = preview_layout({2, 1});
  const Picture picture = drawn(draw_preview({2, 1, 1.0, {1.0F, 1.0F}}, raster, {}));
  EXPECT_EQ(picture.at(layout.map), colour_of_svf(0.0));
  EXPECT_EQ(picture.at(layout.colour_bar), colour_of_svf(0.0)) << "the largest value stands above";
}

TEST(ValueScale, HasTicksThatPeopleRead) {
  const auto ticks = [](double max_value) {
    std::vector<std::string> texts;
    const ValueScale scale = scale_of({"sunlit_h", "h", ""}, max_value);
    for (const double tick : scale.ticks()) texts.push_back(tick_text(tick, scale.step()));
    return texts;
  };
  EXPECT_THAT(ticks(12.58), testing::ElementsAre("0", "5", "10"));
  EXPECT_THAT(ticks(4283.0), testing::ElementsAre("0", "1000", "2000", "3000", "4000"));
  EXPECT_THAT(ticks(0.0), testing::ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(ticks(0.037), testing::ElementsAre("0.00", "0.01", "0.02", "0.03"));
}

TEST(TickStep, IsTheLeastThatGivesFewSteps) {
  EXPECT_DOUBLE_EQ(tick_step(10.0, 5), 2.0);
  EXPECT_DOUBLE_EQ(tick_step(10.1, 5), 5.0);
  EXPECT_DOUBLE_EQ(tick_step(0.25, 5), 0.05);
  EXPECT_DOUBLE_EQ(tick_step(7.0, 7), 1.0);
  EXPECT_DOUBLE_EQ(tick_step(99.0, 10), 10.0);
}

TEST(Preview, OutlinesAreDarkLinesOfTheMap) {
  const PreviewRaster raster{100, 100, 1.0, std::vector<float>(10'000, 1.0F), 10};
  const Picture picture = drawn(draw_preview(raster, raster_of(100, 100, 1.0F), {{{{20.0, 50.5}, {80.0, 50.5}}}, {}}));
  const Pixel map = preview_layout({100, 100}).map;
  EXPECT_LT(luminance(picture.at({map.x + 50, map.y + 50})), 0.4 * luminance(colour_of_svf(1.0)));
  EXPECT_EQ(picture.at({map.x + 50, map.y + 52}), colour_of_svf(1.0));
  EXPECT_EQ(picture.at({map.x + 10, map.y + 50}), colour_of_svf(1.0));
}

/// A line as wide as the pixels of the raster hid pavements.
TEST(Preview, OutlinesHideLittleOfSmallPixels) {
  for (const std::size_t enlarged_by : {1U, 2U, 3U}) {
    const PreviewRaster raster{100, 100, 1.0, std::vector<float>(10'000, 1.0F), enlarged_by};
    const Drawing drawing = draw_preview(raster, raster_of(100, 100, 1.0F), {{{{20.0, 50.5}, {80.0, 50.5}}}, {}});
    const Pixel map = preview_layout({100, 100}).map;
    double seen = 0.0;
    for (std::size_t y = 50; y < 50 + enlarged_by; ++y) seen += luminance(drawn(drawing).at({map.x + 50, map.y + y}));
    EXPECT_GT(seen, 0.6 * luminance(colour_of_svf(1.0)) * static_cast<double>(enlarged_by)) << enlarged_by;
  }
}

TEST(ScaleBar, IsRoundAndAsLongAsItMayBe) {
  EXPECT_EQ(round_length_m(199.0), 100.0);
  EXPECT_EQ(round_length_m(200.0), 200.0);
  EXPECT_EQ(round_length_m(9.9), 5.0);
  EXPECT_EQ(round_length_m(1.0), 1.0);
  EXPECT_EQ(round_length_m(0.3), 0.2);
}

TEST(ScaleBar, IsNoWiderThanItsMap) {
  const auto width_at = [](std::size_t map_width) {
    Drawing drawing{{400, 100}, "map"};
    add_scale_bar(drawing, {10.0, 10.0}, 1.0, map_width);
    const auto& corners = std::get<Line>(drawing.shapes.front()).places;
    return corners.back().x - corners.front().x;
  };
  EXPECT_EQ(width_at(1000), 200.0);
  EXPECT_EQ(width_at(60), 50.0);
  EXPECT_EQ(width_at(3), 2.0);
}

const RasterPlan small_plan{{0.0, 0.0}, 2.0, 8, 6};

/// A plane that rises by so much a metre to the east and to the north.
std::vector<float> plane(double east, double north) {
  std::vector<float> heights;
  for (std::size_t row = 0; row < small_plan.rows; ++row)
    for (std::size_t column = 0; column < small_plan.columns; ++column) {
      const Point2d p = small_plan.centre_m(column, row);
      heights.push_back(static_cast<float>(east * p.x + north * p.y));
    }
  return heights;
}

/// Of a handful of floats near 1.
constexpr float rounding = 1e-5F;

TEST(Shading, LevelGroundHasNone) { EXPECT_TRUE(shading_of(plane(0.0, 0.0), small_plan).empty()); }

TEST(Shading, WhatLooksToTheNorthWestIsLit) {
  // It falls to the north-west, and therefore rises to the east and the south
  for (const float f : shading_of(plane(0.3, -0.3), small_plan)) EXPECT_GT(f, 1.1F);
  for (const float f : shading_of(plane(-0.3, 0.3), small_plan)) EXPECT_LT(f, 0.9F);
}

TEST(Shading, IsWhatLambertsLawSays) {
  const double slope = 0.2;
  const std::vector<float> shading = shading_of(plane(slope, 0.0), small_plan);
  const double up = std::numbers::sqrt2 / 2.0;
  const double light = (0.5 * slope + up) / std::hypot(1.0, slope) / up;
  for (const float f : shading) EXPECT_NEAR(f, light, rounding);
}

TEST(Shading, UnknownGroundIsTakenAsLevel) {
  std::vector<float> heights = plane(0.3, -0.3);
  const std::size_t hole = 3 * small_plan.columns + 4;
  for (const std::size_t n : {hole - 1, hole, hole + 1, hole - small_plan.columns, hole + small_plan.columns})
    heights[n] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> shading = shading_of(heights, small_plan);
  EXPECT_EQ(shading[hole], 1.0F);
  EXPECT_GT(shading[0], 1.1F);
}

TEST(Shading, AWeakSlopeThatNobodySeesIsLeftOut) {
  EXPECT_TRUE(shading_of(plane(0.01, 0.0), small_plan).empty());
  EXPECT_FALSE(shading_of(plane(0.1, 0.0), small_plan).empty());
}

TEST(Shading, OneSteepPixelInThousandsIsNoRelief) {
  const RasterPlan plan{{0.0, 0.0}, 2.0, 100, 100};
  std::vector<float> heights(10'000, 5.0F);
  heights[5050] = 9.0F;
  EXPECT_TRUE(shading_of(heights, plan).empty());
}

TEST(ClippedSegment, EndsAtTheBorder) {
  const auto middle = clipped({{-10.0, 5.0}, {30.0, 5.0}}, {0.0, 0.0}, {20.0, 10.0});
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->a.x, 0.0);
  EXPECT_EQ(middle->b.x, 20.0);
  EXPECT_EQ(middle->a.y, 5.0);
  const auto corner = clipped({{-5.0, 5.0}, {5.0, -5.0}}, {0.0, 0.0}, {20.0, 10.0});
  ASSERT_TRUE(corner) << "it touches the corner";
  EXPECT_FALSE(clipped({{-5.0, 4.0}, {4.0, -5.0}}, {0.0, 0.0}, {20.0, 10.0}));
  EXPECT_FALSE(clipped({{21.0, 1.0}, {21.0, 9.0}}, {0.0, 0.0}, {20.0, 10.0}));
  const auto inside = clipped({{3.0, 4.0}, {5.0, 6.0}}, {0.0, 0.0}, {20.0, 10.0});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->a.x, 3.0);
  EXPECT_EQ(inside->b.y, 6.0);
}

}  // namespace
}  // namespace farlod
