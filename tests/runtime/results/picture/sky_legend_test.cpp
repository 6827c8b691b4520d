// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "results/picture/cell_picture.hpp"
#include "results/picture/far_panorama.hpp"
#include "results/picture/sky_picture.hpp"

namespace farlod {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;

/// A sky of four azimuths with these parts, from the zenith down to the horizon the same.
std::vector<std::string> words_of_sky(const std::vector<SkyPart>& parts) {
  const Hemisphere hemisphere{parts.size(), 1, parts, std::vector<float>(parts.size(), 0.5F), 0.0, 0.5F, {}};
  std::vector<std::string> words;
  for (const auto& shape : draw_sky(hemisphere, SkyProjection::equidistant, {"svf", ""}, {}, {}).shapes)
    if (const auto* text = std::get_if<Text>(&shape)) words.push_back(text->words);
  return words;
}

TEST(SkyLegend, NamesTheColoursThatAreThere) {
  const auto in_town = words_of_sky({SkyPart::sky, SkyPart::near, SkyPart::far});
  EXPECT_THAT(in_town, IsSupersetOf({"sky that is seen", "buildings, ground: near", "buildings, ground: far"}));
  EXPECT_THAT(in_town, Not(Contains("crowns of trees")));
  const auto in_park = words_of_sky({SkyPart::sky, SkyPart::crown});
  EXPECT_THAT(in_park, Contains("crowns of trees"));
  EXPECT_THAT(in_park, Not(Contains("buildings, ground: far")));
}

std::vector<std::string> words_drawn_in(const Drawing& drawing) {
  std::vector<std::string> words;
  for (const auto& shape : drawing.shapes)
    if (const auto* text = std::get_if<Text>(&shape)) words.push_back(text->words);
  return words;
}

TEST(PanoramaLegend, NamesTheColoursThatAreThere) {
  const auto words_of = [](const FarView& view) {
    Drawing drawing{{400, 400}, ""};
    (void)add_panorama_legend(drawing, {}, view);
    return words_drawn_in(drawing);
  };
  const char *const hidden = "residual city: hidden for certain (low)", *const undecided =
                                                                            "residual city: undecided (up to high)";
  FarView view;
  view.horizon = {{}, {0.0F, 0.0F}, {0.1F, 0.0F}, {0.2F, 0.0F}, {}};
  EXPECT_THAT(words_of(view), Contains(undecided));
  EXPECT_THAT(words_of(view), Not(testing::AnyOf(Contains(hidden), Contains("explicit far edges"))));
  view.horizon.low = view.horizon.high;
  view.horizon.edges.resize(1);
  EXPECT_THAT(words_of(view), IsSupersetOf({hidden, "explicit far edges"}));
  EXPECT_THAT(words_of(view), Not(Contains(undecided)));
  view.box.distance_m = {10.0F, 20.0F};
  EXPECT_THAT(words_of(view), Not(Contains("sky")));
  view.box.distance_m = {10.0F, std::numeric_limits<float>::infinity()};
  EXPECT_THAT(words_of(view), IsSupersetOf({"sky", "hidden by what is near the box"}));
}

TEST(CellLegend, NamesTheZonesThatAreThere) {
  CellScenery scenery;
  scenery.contents.corners_projected = {{{0.0, 0.0}, {50.0, 0.0}, {50.0, 50.0}, {0.0, 50.0}}};
  scenery.contents.neighborhood = {-1, -1, 2, 2};
  const auto add_part = [&](CellPlace cell) { scenery.around.emplace_back().cell = cell; };
  add_part({0, 0});
  add_part({1, 0});
  EXPECT_THAT(words_drawn_in(draw_cell(scenery)), IsSupersetOf({"the cell", "near: its neighborhood"}));
  EXPECT_THAT(words_drawn_in(draw_cell(scenery)), Not(Contains("far: in the far map")));
  add_part({2, 0});
  EXPECT_THAT(words_drawn_in(draw_cell(scenery)), Contains("far: in the far map"));
}

/// Grey on what is dark, they were not read.
TEST(SkyLegend, ElevationsAreReadOnAnyColour) {
  const Hemisphere dark{1, 1, {SkyPart::near}, {0.5F}, 0.0, 0.5F, {}};
  std::size_t found = 0;
  for (const auto& shape : draw_sky(dark, SkyProjection::equidistant, {"svf", ""}, {}, {}).shapes)
    if (const auto* text = std::get_if<Text>(&shape); text != nullptr && (text->words == "30°" || text->words == "60°")) {
      ++found;
      EXPECT_EQ(text->colour, ink);
      EXPECT_EQ(text->halo, (Colour{255, 255, 255}));
    }
  EXPECT_EQ(found, 2U);
}

}  // namespace
}  // namespace farlod
