// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <string>
#include <variant>
#include <vector>

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
