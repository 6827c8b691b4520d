// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/preview_layout.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "results/picture/map_legend.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;

constexpr PixelSize low{1000, 100}, tall{150, 1000}, square{1000, 1000};

TEST(PreviewLayout, HoldsAllItsParts) {
  for (const PixelSize map : {PixelSize{1, 1}, PixelSize{1000, 1}, PixelSize{1, 2000}, PixelSize{2000, 2000}, low, tall}) {
    const PreviewLayout layout = preview_layout(map, {2, 3, 5, true});
    const std::size_t end_of_colours = layout.colour_bar.y + layout.colour_bar_size.height;
    EXPECT_EQ(layout.map.x + map.width + 16, layout.colour_bar.x) << "beside its map, however narrow that is";
    EXPECT_LT(layout.map.y + map.height, layout.picture.height);
    EXPECT_LT(end_of_colours, layout.picture.height);
    EXPECT_LT(layout.colour_bar.x + layout.colour_bar_size.width, layout.picture.width);
    EXPECT_LT(layout.legend.x + static_cast<std::size_t>(legend_width(map)), layout.picture.width);
    EXPECT_LT(layout.legend.y + 5 * static_cast<std::size_t>(line_of_legend), layout.picture.height);
    EXPECT_LT(layout.north_arrow.y + 40, layout.picture.height);
    EXPECT_LT(layout.north_arrow.x, layout.picture.width);
  }
}

/// The footer hides neither the map nor the colours.
TEST(PreviewLayout, TheFooterStandsWhereThereIsRoom) {
  for (const PixelSize map : {square, low, PixelSize{400, 300}}) {
    const PreviewLayout layout = preview_layout(map);
    EXPECT_GT(layout.footer.y, layout.map.y + map.height);
    const bool is_below_colours = layout.footer.y > layout.colour_bar.y + layout.colour_bar_size.height;
    EXPECT_TRUE(is_below_colours ||
                static_cast<double>(layout.legend.x) + legend_width(map) < static_cast<double>(layout.colour_bar.x));
  }
  const PreviewLayout beside = preview_layout(tall);
  EXPECT_EQ(beside.footer.x, beside.colour_bar.x);
  EXPECT_GT(beside.footer.y, beside.colour_bar.y + beside.colour_bar_size.height);
}

/// Half of the picture of a tall map was empty, and a third of that of a low one.
TEST(PreviewLayout, FitsNarrowMaps) {
  EXPECT_LT(preview_layout(tall).picture.width, tall.width + 300);
  EXPECT_LT(preview_layout(tall).picture.height, tall.height + 130);
  EXPECT_LT(preview_layout({1000, 20}).picture.height, 260U);
}

TEST(PreviewLayout, MakesRoomForLinesOfTheHeading) {
  EXPECT_EQ(preview_layout(tall, {2, 3, 1, false}).map.y, preview_layout(tall).map.y + 28 + 2 * 20);
  EXPECT_GT(preview_layout(square, {1, 1, 1, true}).map.y, preview_layout(square).map.y) << "for the unit above the colours";
}

TEST(InLines, CutsNoWord) {
  EXPECT_THAT(in_lines("one two three", 10.0, 1000.0), ElementsAre("one two three"));
  EXPECT_THAT(in_lines("one two three", 10.0, width_of_words("one two", 10.0)), ElementsAre("one two", "three"));
  EXPECT_THAT(in_lines("unbreakable", 10.0, 1.0), ElementsAre("unbreakable"));
  EXPECT_THAT(in_lines("", 10.0, 100.0), ElementsAre(""));
}

TEST(WidthOfWords, CountsLettersAndNotBytes) {
  EXPECT_DOUBLE_EQ(width_of_words("°", 15.0), width_of_words("o", 15.0));
  EXPECT_GT(width_of_words("mm", 15.0), width_of_words("ii", 15.0));
}

using Sign = LegendEntry::Sign;

std::vector<std::vector<std::string>> words_of(const std::vector<LegendRow>& rows) {
  std::vector<std::vector<std::string>> words;
  for (const LegendRow& row : rows) {
    words.emplace_back();
    for (const LegendEntry& entry : row) words.back().push_back(entry.words);
  }
  return words;
}

TEST(MapLegend, FillsRow) {
  const std::vector<LegendEntry> entries{{Sign::box, {}, "buildings"}, {Sign::line, {}, "roofs"}, {Sign::none, {}, "lit ground"}};
  EXPECT_THAT(words_of(legend_in_rows(entries, 400.0)),
              ElementsAre(ElementsAre("buildings", "roofs"), ElementsAre("lit ground")));
  EXPECT_THAT(words_of(legend_in_rows(entries, 120.0)),
              ElementsAre(ElementsAre("buildings"), ElementsAre("roofs"), ElementsAre("lit ground")));
  EXPECT_THAT(words_of(legend_in_rows(entries, 60.0)).back(), ElementsAre("ground"));
}

TEST(MapLegend, ShortensWhatNoRowHolds) {
  const std::string id = "landmark urn:uuid:3f2504e0-4f89-41d3-9a0c-0305e82c3301";
  const auto words = words_of(legend_in_rows({{Sign::box, {}, id}}, 200.0));
  ASSERT_THAT(words, ElementsAre(testing::SizeIs(1)));
  const std::string& cut = words.front().front();
  EXPECT_TRUE(cut.starts_with("landmark urn:uuid:3f")) << cut;
  EXPECT_TRUE(cut.ends_with("…")) << cut;
  EXPECT_LE(width_of_words(cut, 15.0), 200.0);
  EXPECT_EQ(words_of(legend_in_rows({{Sign::box, {}, "öööö"}}, 45.0)).front().front(), "ö…") << "letters of two bytes stay whole";
}

}  // namespace
}  // namespace farlod
