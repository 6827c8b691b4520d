// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/city_picture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "tests/runtime/results/picture/decoded_png.hpp"

namespace farlod {
namespace {

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
constexpr Colour blank{255, 255, 255};

/// 60 × 40 pixels of 10 m on level ground at 100 m. The west is beyond the grid; a house of 12 m is in columns 20 to 29 of rows
/// 10 to 19, and a tower of 90 m in columns 40 and 41 of row 30.
CityScenery small_city() {
  CityScenery scenery;
  scenery.plan = {{500'000.0, 5'500'400.0}, 10.0, 60, 40};
  for (std::size_t n = 0; n < 60 * 40; ++n) {
    const std::size_t column = n % 60, row = n / 60;
    const bool is_house = 20 <= column && column < 30 && 10 <= row && row < 20;
    const bool is_tower = 40 <= column && column < 42 && row == 30;
    scenery.heights.ground_m.push_back(column < 10 ? nowhere : 100.0F);
    scenery.heights.highest_m.push_back(column < 10 ? nowhere : is_house ? 112.0F : is_tower ? 190.0F : 100.0F);
  }
  scenery.grid = {
      {{{500'100.0, 5'500'000.0}, {500'600.0, 5'500'000.0}, {500'600.0, 5'500'400.0}, {500'100.0, 5'500'400.0}}}, 1, 1, 500.0};
  scenery.package = "town.farlod";
  return scenery;
}

class CityPicture : public testing::Test {
 protected:
  [[nodiscard]] Colour at(std::size_t column, std::size_t row) const { return picture().at({map_.x + column, map_.y + row}); }
  [[nodiscard]] Picture picture() const { return drawn(draw_city(scenery_)); }

  CityScenery scenery_ = small_city();
  Pixel map_ = city_layout(scenery_.plan).map;
};

TEST_F(CityPicture, HasTheColoursOfWhatIsThere) {
  const CityScale scale = scale_of(scenery_.heights);
  EXPECT_EQ(scale.top_m, 90.0) << "two pixels of 102 are more than one in a hundred";
  EXPECT_EQ(at(25, 15), colour_of_height(12.0 / 90.0));
  EXPECT_EQ(at(15, 15), colour_of_ground(1.0));
  EXPECT_EQ(at(5, 15), blank) << "beyond the grid";
  EXPECT_EQ(picture().size(), city_layout(scenery_.plan).picture);
}

TEST_F(CityPicture, AFewTowersDoNotDecideTheScale) {
  scenery_.heights.highest_m[30 * 60 + 41] = 100.0F;  // one pixel of the tower, of 101 of buildings, is left
  const CityScale scale = scale_of(scenery_.heights);
  EXPECT_EQ(scale.top_m, 15.0) << "12 m, and the next multiple of 5 m";
  EXPECT_EQ(scale.highest_m, 90.0);
  EXPECT_EQ(scale.highest_at, 30U * 60 + 40);
  EXPECT_EQ(colour_in_city(100.0, 190.0, scale), colour_of_height(1.0));
}

TEST_F(CityPicture, ElevationsHaveNoZerosBehindThePoint) {
  const auto words = [&] {
    std::vector<std::string> all;
    for (const auto& shape : draw_city(scenery_).shapes)
      if (const auto* text = std::get_if<Text>(&shape)) all.push_back(text->words);
    return all;
  };
  EXPECT_THAT(words(), testing::Contains("100 m"));
  for (float& ground_m : scenery_.heights.ground_m) ground_m -= 100.0F;
  scenery_.heights.ground_m.back() = -0.02F;
  EXPECT_THAT(words(), testing::Not(testing::AnyOf(testing::Contains("0.0 m"), testing::Contains("-0 m"))))
      << "level ground at 0";
  scenery_.heights.ground_m.back() = 12.34F;
  EXPECT_THAT(words(), testing::Contains("12.3 m"));
}

/// The ring around the highest pixel, eight pixels from it.
TEST_F(CityPicture, RingsTheHighest) {
  EXPECT_NE(at(48, 30), colour_of_ground(1.0));
  EXPECT_EQ(at(40, 30), colour_of_height(1.0)) << "the ring leaves its middle free";
  scenery_.heights.highest_m = scenery_.heights.ground_m;  // as where all buildings lie below the ground
  EXPECT_EQ(scale_of(scenery_.heights).top_m, 0.0);
  EXPECT_EQ(at(48, 30), colour_of_ground(1.0));
  EXPECT_EQ(at(25, 15), colour_of_ground(1.0));
}

/// A model of surfaces has no buildings, and is no plain without any.
TEST_F(CityPicture, ASurfaceModelIsNoGroundWithoutBuildings) {
  scenery_.heights.highest_m = scenery_.heights.ground_m;
  const auto words = [&] {
    std::vector<std::string> all;
    for (const auto& shape : draw_city(scenery_).shapes)
      if (const Text* text = std::get_if<Text>(&shape)) all.push_back(text->words);
    return all;
  };
  using testing::Contains, testing::Not;
  EXPECT_THAT(words(), Contains("No building rises above the ground."));
  EXPECT_THAT(words(), Contains("Ground"));
  EXPECT_THAT(words(), Not(Contains("Buildings"))) << "the name of no scale";
  scenery_.is_surface_model = true;
  EXPECT_THAT(words(), Contains("A surface model: buildings are a part of the surface."));
  EXPECT_THAT(words(), Contains("Surface"));
  EXPECT_THAT(words(), Not(Contains("No building rises above the ground.")));
  scenery_ = small_city();
  EXPECT_THAT(words(), Contains("Buildings"));
}

/// Crowns were as grey as the ground below them.
TEST_F(CityPicture, CrownsHaveAColourAndAName) {
  const auto names_crowns = [&] {
    return std::ranges::any_of(draw_city(scenery_).shapes, [](const auto& shape) {
      const Text* text = std::get_if<Text>(&shape);
      return text != nullptr && text->words == "crowns";
    });
  };
  EXPECT_FALSE(names_crowns());
  scenery_.crown_tops_m.assign(60 * 40, nowhere);
  scenery_.crown_tops_m[15 * 60 + 24] = 110.0F;  // below the roof
  EXPECT_FALSE(names_crowns());
  scenery_.crown_tops_m[15 * 60 + 15] = 108.0F;
  scenery_.crown_tops_m[15 * 60 + 25] = 118.0F;  // above the roof
  EXPECT_TRUE(names_crowns());
  EXPECT_EQ(at(15, 15), colour_of_crowns());
  EXPECT_EQ(at(25, 15), colour_of_crowns());
  EXPECT_EQ(at(24, 15), colour_of_height(12.0 / 90.0));
  EXPECT_EQ(at(16, 15), colour_of_ground(1.0));
}

TEST_F(CityPicture, MarksPlacesOfAReport) {
  const Point2d place = scenery_.plan.centre_m(50, 8);
  const Colour before = at(50, 8);
  scenery_.marked = {"report.geojson", {place, {499'000.0, 5'500'000.0}}};
  EXPECT_NE(at(50, 8), before);
  EXPECT_EQ(at(50, 16), colour_of_ground(1.0)) << "eight pixels beside it";
}

/// Cells of 20 m are two pixels wide: a line for each would hide the city.
TEST_F(CityPicture, DrawsNoMoreLinesThanCanBeSeen) {
  const auto lines_in_row = [&] {
    const Picture seen = picture();
    std::size_t lines = 0;
    for (std::size_t column = 10; column < 60; ++column)
      lines += seen.at({map_.x + column, map_.y + 25}) != colour_of_ground(1.0) ? 1 : 0;
    return lines;
  };
  const std::size_t borders = lines_in_row();
  scenery_.grid.columns = 25;
  scenery_.grid.rows = 20;
  scenery_.grid.cell_edge_m = 20.0;
  // A line for each twelve cells is two of them besides the border; each lies on a pixel or between two
  EXPECT_GE(lines_in_row(), borders + 1);
  EXPECT_LE(lines_in_row(), borders + 4);
}

/// A slope that looks to the north-west is lighter than its elevation says.
TEST_F(CityPicture, LightsTheGround) {
  for (std::size_t n = 0; n < scenery_.heights.ground_m.size(); ++n)
    scenery_.heights.ground_m[n] = 100.0F + 5.0F * static_cast<float>(n % 60);
  scenery_.heights.highest_m = scenery_.heights.ground_m;
  const CityScale scale = scale_of(scenery_.heights);
  EXPECT_GT(at(30, 20).red, colour_in_city(250.0, 250.0, scale).red);
}

}  // namespace
}  // namespace farlod
