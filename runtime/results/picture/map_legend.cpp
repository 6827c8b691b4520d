// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/map_legend.hpp"

#include <cmath>
#include <cstddef>

#include "results/picture/preview_layout.hpp"

namespace farlod {
namespace {

using Sign = LegendEntry::Sign;

constexpr double edge_of_sign = 14.0, length_of_line = 22.0, away_from_sign = 8.0, away_from_next = 14.0;

double width_of_sign(Sign sign) {
  if (sign == Sign::none) return 0.0;
  return (sign == Sign::box ? edge_of_sign : length_of_line) + away_from_sign;
}

double width_of(const LegendEntry& entry) {
  return width_of_sign(entry.sign) + std::ceil(width_of_words(entry.words, text_height));
}

/// Cut at its end until it fits; letters of several bytes stay whole.
std::string shortened(const std::string& words, double width) {
  if (width_of_words(words, text_height) <= width) return words;
  std::string cut = words;
  const auto is_in_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (!cut.empty() && width_of_words(cut + "…", text_height) > width) {
    while (is_in_letter(cut.back())) cut.pop_back();
    cut.pop_back();
  }
  return cut + "…";
}

void add_sign(Drawing& drawing, PagePoint place, const LegendEntry& entry) {
  if (entry.sign == Sign::box) {
    constexpr double rim = 1.0;
    drawing.shapes.emplace_back(box(place, edge_of_sign, edge_of_sign, muted));
    drawing.shapes.emplace_back(
        box({place.x + rim, place.y + rim}, edge_of_sign - 2.0 * rim, edge_of_sign - 2.0 * rim, entry.colour));
  } else if (entry.sign == Sign::line) {
    const double y = place.y + 7.5, width = 0.7;
    drawing.shapes.emplace_back(Line{{{place.x, y}, {place.x + length_of_line, y}}, width, entry.colour});
  }
}

}  // namespace

std::vector<LegendRow> legend_in_rows(const std::vector<LegendEntry>& entries, double width) {
  std::vector<LegendRow> rows;
  double used = width;
  for (LegendEntry entry : entries) {
    if (entry.sign == Sign::none) {
      for (const std::string& line : in_lines(entry.words, text_height, width)) rows.push_back({{Sign::none, {}, line}});
      used = width;
      continue;
    }
    entry.words = shortened(entry.words, width - width_of_sign(entry.sign));
    const double with_next = used + away_from_next + width_of(entry);
    if (rows.empty() || with_next > width) rows.emplace_back();
    used = rows.back().empty() ? width_of(entry) : with_next;
    rows.back().push_back(std::move(entry));
  }
  return rows;
}

void add_legend_rows(Drawing& drawing, PagePoint upper_left, const std::vector<LegendRow>& rows) {
  PagePoint place = upper_left;
  for (const LegendRow& row : rows) {
    for (const LegendEntry& entry : row) {
      add_sign(drawing, place, entry);
      drawing.shapes.emplace_back(Text{{place.x + width_of_sign(entry.sign), place.y + edge_of_sign - 2.0},
                                       entry.words,
                                       text_height,
                                       Alignment::left,
                                       entry.sign == Sign::none ? muted : ink});
      place.x += width_of(entry) + away_from_next;
    }
    place = {upper_left.x, place.y + line_of_legend};
  }
}

}  // namespace farlod
