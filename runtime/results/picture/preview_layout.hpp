// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/picture/drawing.hpp"

namespace farlod {

/// Where the parts of a preview lie: the title above the map, the colour scale to its right, scale bar and legend below, or,
/// where the map is narrow and high, below the colour scale.
struct PreviewLayout {
  PixelSize picture;
  Pixel map;
  PixelSize map_size;
  Pixel colour_bar;
  PixelSize colour_bar_size;
  Pixel footer;  ///< of the scale bar
  Pixel legend;
  Pixel north_arrow;  ///< its tip
};

/// How long the words of a preview are.
struct PreviewWords {
  std::size_t title_lines = 1, subtitle_lines = 1, legend_rows = 1;
  bool are_beyond_map = false;  ///< a line of the heading stands above the colour scale
};

/// The picture is no larger than its parts need.
[[nodiscard]] PreviewLayout preview_layout(PixelSize map_size, const PreviewWords& words = {});
/// The same with all of the footer below the map, for more words than have room beside it.
[[nodiscard]] PreviewLayout layout_with_footer(PixelSize map_size, const PreviewWords& words = {});

inline constexpr double line_of_title = 28.0, line_of_subtitle = 20.0, line_of_legend = 22.0;

/// How wide headings, and rows of the legend, may be: of preview_layout().
[[nodiscard]] double heading_width(PixelSize map_size);
[[nodiscard]] double legend_width(PixelSize map_size);

/// The width of words, more or less.
[[nodiscard]] double width_of_words(const std::string& words, double height);
/// Words in lines no wider than that, but that no word is cut.
[[nodiscard]] std::vector<std::string> in_lines(const std::string& words, double height, double width);

}  // namespace farlod
