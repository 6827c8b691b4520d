// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/preview_layout.hpp"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "results/picture/picture.hpp"

namespace farlod {
namespace {

constexpr std::size_t margin = 24, gap = 16, heading_height = 50;
constexpr PixelSize legend_size{96, 280};
constexpr std::size_t colour_bar_width = 28, footer_height = 48, scale_bar_width = 230;
constexpr PixelSize arrow_size{40, 44};
constexpr std::size_t narrowest_content = 560;                          // scale bar and legend must fit
constexpr std::size_t side_width = 220, narrowest_beside_tall = 320;    // the same, of a legend beside its map
constexpr std::size_t least_height_of_tall = legend_size.height + 170;  // of the colours, and of the legend below them

bool is_tall(PixelSize map) { return map.width + gap + side_width <= narrowest_content && map.height >= least_height_of_tall; }

/// The colours reach further down than the map, which has room for the footer beside them.
bool is_low(PixelSize map) { return map.width >= narrowest_content && map.height < legend_size.height / 2; }

std::size_t content_width(PixelSize map) {
  if (is_tall(map)) return std::max(map.width + gap + side_width, narrowest_beside_tall);
  return std::max(map.width + gap + legend_size.width, narrowest_content);
}

std::size_t height_of_rows(std::size_t rows) { return rows * static_cast<std::size_t>(line_of_legend); }

/// The footer has two rows, whether they are needed or not.
std::size_t height_of_footer(const PreviewWords& words) {
  return footer_height + height_of_rows(std::max<std::size_t>(words.legend_rows, 2) - 2);
}

PreviewLayout layout_of_map(PixelSize map_size, const PreviewWords& words) {
  constexpr std::size_t below_long_heading = 12;  // the unit stands above the colours, and must not touch the heading
  const double further_lines = static_cast<double>(words.title_lines - 1) * line_of_title +
                               static_cast<double>(words.subtitle_lines - 1) * line_of_subtitle;
  PreviewLayout layout;
  layout.map = {margin, margin + heading_height + gap + static_cast<std::size_t>(further_lines) +
                            (words.are_beyond_map ? below_long_heading : 0)};
  layout.map_size = map_size;
  // The scale stands beside its map, however narrow that is
  layout.colour_bar = {margin + map_size.width + gap, layout.map.y};
  layout.colour_bar_size = {colour_bar_width, std::min(std::max(map_size.height, legend_size.height / 2), legend_size.height)};
  layout.picture.width = margin + content_width(map_size) + margin;
  return layout;
}

}  // namespace

PreviewLayout layout_with_footer(PixelSize map_size, const PreviewWords& words) {
  PreviewLayout layout = layout_of_map(map_size, words);
  layout.picture.width = margin + std::max(map_size.width + gap + legend_size.width, narrowest_content) + margin;
  layout.footer = {margin, layout.map.y + std::max(map_size.height, layout.colour_bar_size.height) + gap};
  layout.legend = {layout.footer.x + scale_bar_width, layout.footer.y + 14};
  layout.north_arrow = {layout.picture.width - margin - legend_size.width / 2, layout.footer.y - 4};
  layout.picture.height = layout.footer.y + height_of_footer(words) + margin;
  return layout;
}

PreviewLayout preview_layout(PixelSize map_size, const PreviewWords& words) {
  if (!is_tall(map_size) && !is_low(map_size)) return layout_with_footer(map_size, words);
  PreviewLayout layout = layout_of_map(map_size, words);
  const std::size_t below_map = layout.map.y + map_size.height,
                    below_colours = layout.colour_bar.y + layout.colour_bar_size.height;
  if (is_tall(map_size)) {
    layout.footer = {layout.colour_bar.x, below_colours + gap};
    layout.legend = {layout.footer.x, layout.footer.y + footer_height};
    layout.north_arrow = {layout.footer.x + colour_bar_width / 2, layout.legend.y + height_of_rows(words.legend_rows) + gap};
    layout.picture.height = std::max(below_map, layout.north_arrow.y + arrow_size.height) + margin;
  } else {
    layout.footer = {margin, below_map + gap};
    layout.legend = {layout.footer.x + scale_bar_width, layout.footer.y + 14};
    layout.north_arrow = {margin + map_size.width - arrow_size.width / 2, layout.footer.y - 4};
    layout.picture.height = std::max(layout.footer.y + height_of_footer(words), below_colours) + margin;
  }
  return layout;
}

double heading_width(PixelSize map_size) { return static_cast<double>(content_width(map_size)); }

double legend_width(PixelSize map_size) {
  if (is_tall(map_size)) return static_cast<double>(content_width(map_size) - map_size.width - gap);
  const std::size_t beside_arrow =
      is_low(map_size) ? map_size.width - arrow_size.width : content_width(map_size) - legend_size.width;
  return static_cast<double>(beside_arrow - scale_bar_width);
}

double width_of_words(const std::string& words, double height) {
  // DejaVu Sans has these, as shares of its size
  constexpr double narrow = 0.37, wide = 0.9, capital = 0.69, other = 0.62;
  double width = 0.0;
  for (const char c : words) {
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U) continue;  // of a letter that is counted
    const auto is_one_of = [c](const char* letters) { return std::strchr(letters, c) != nullptr; };
    width += is_one_of(" .,:;|()/-fijlrtI") ? narrow : is_one_of("mwMW") ? wide : 'A' <= c && c <= 'Z' ? capital : other;
  }
  return width * height;
}

std::vector<std::string> in_lines(const std::string& words, double height, double width) {
  std::vector<std::string> lines(1);
  std::istringstream text(words);
  for (std::string word; text >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || width_of_words(longer, height) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

}  // namespace farlod
