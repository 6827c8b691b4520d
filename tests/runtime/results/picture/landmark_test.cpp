// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "results/picture/raster_preview.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"

namespace farlod {
namespace {

constexpr std::size_t edge = 100;

/// A map of the view of building B, which fills some columns and rows; all pixels have this value.
class LandmarkPicture : public testing::Test {
 protected:
  LandmarkPicture() {
    frame_.columns = frame_.rows = edge;
    frame_.bands = {{"view_building", "1", ""}};
    frame_.landmark = "B";
    background_.is_landmark.assign(edge * edge, false);
  }
  void place_landmark(std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (std::size_t column = begin; column < end; ++column) background_.is_landmark[row * edge + column] = true;
  }
  [[nodiscard]] Drawing drawing(float value) const {
    return draw_preview({edge, edge, 1.0, std::vector<float>(edge * edge, value)}, frame_, background_);
  }
  [[nodiscard]] static Colour colour_at(const Drawing& drawing, std::size_t column, std::size_t row) {
    const auto map = std::ranges::find_if(drawing.shapes, [](const auto& shape) { return std::holds_alternative<Image>(shape); });
    const Pixel corner = std::get<Image>(*map).upper_left;
    return drawn(drawing).at({corner.x + column, corner.y + row});
  }
  [[nodiscard]] static bool has_words(const Drawing& drawing, const std::string& words) {
    return std::ranges::any_of(drawing.shapes, [&](const auto& shape) {
      const Text* text = std::get_if<Text>(&shape);
      return text != nullptr && text->words == words;
    });
  }

  RasterFrame frame_;
  PlanBackground background_;
};

TEST_F(LandmarkPicture, IsFilledWhereItHasNoValues) {
  place_landmark(30, 70);
  EXPECT_EQ(colour_at(drawing(NAN), 50, 50), landmark_colour);
  EXPECT_EQ(colour_at(drawing(NAN), 20, 50), no_value_grey);
  EXPECT_TRUE(has_words(drawing(NAN), "landmark B"));
}

TEST_F(LandmarkPicture, HasARimWhereItHasValues) {
  place_landmark(30, 70);
  EXPECT_EQ(colour_at(drawing(1.0F), 50, 31), landmark_colour);
  EXPECT_EQ(colour_at(drawing(1.0F), 50, 50), colour_of_svf(1.0));
}

/// A few pixels of a large city are not found without it.
TEST_F(LandmarkPicture, HasARingWhereItIsSmall) {
  place_landmark(49, 51);
  EXPECT_EQ(colour_at(drawing(NAN), 50, 50), landmark_colour);
  EXPECT_NE(colour_at(drawing(NAN), 64, 50), no_value_grey) << "14 pixels beside its middle";
  background_.is_landmark.assign(edge * edge, false);
  place_landmark(30, 70);
  EXPECT_EQ(colour_at(drawing(NAN), 29, 50), no_value_grey);
}

TEST_F(LandmarkPicture, IsNotNamedWhereItIsNotSeen) {
  EXPECT_FALSE(has_words(drawing(NAN), "landmark B"));
  background_.is_landmark = {};
  EXPECT_FALSE(has_words(drawing(NAN), "landmark B"));
}

/// Dark colours of small shares say that it is seen.
TEST_F(LandmarkPicture, HasAColourForPlacesThatSeeNothingOfIt) {
  place_landmark(30, 70);
  EXPECT_EQ(colour_at(drawing(0.0F), 5, 5), unseen_colour);
  EXPECT_TRUE(has_words(drawing(0.0F), "nothing of it is seen"));
  EXPECT_NE(colour_at(drawing(0.001F), 5, 5), unseen_colour);
  EXPECT_FALSE(has_words(drawing(0.001F), "nothing of it is seen"));
  frame_.landmark = {};
  EXPECT_NE(colour_at(drawing(0.0F), 5, 5), unseen_colour);
}

/// A legend of what is all landmark names no other building.
TEST_F(LandmarkPicture, HasNoGreyOfItsOwn) {
  place_landmark(0, edge);
  EXPECT_FALSE(has_words(drawing(NAN), "no data"));
}

}  // namespace
}  // namespace farlod
