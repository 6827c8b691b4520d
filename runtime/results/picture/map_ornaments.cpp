// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/map_ornaments.hpp"

#include <cmath>

#include "results/decimal.hpp"
#include "results/picture/picture_style.hpp"

namespace farlod {
namespace {

constexpr double line_width = 1.5, tick = 6.0;
constexpr double arrow_height = 28.0, arrow_half_width = 9.0;
constexpr double longest_scale_bar = 200.0;

}  // namespace

double round_length_m(double limit_m) {
  const double power = std::pow(10.0, std::floor(std::log10(limit_m)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= limit_m) return digit * power;
  return power;
}

void add_scale_bar(Drawing& drawing, PagePoint place, double metres_per_pixel) {
  const double length_m = round_length_m(longest_scale_bar * metres_per_pixel), width = length_m / metres_per_pixel;
  const double y = place.y + text_height + 12.0;
  drawing.shapes.emplace_back(
      Line{{{place.x, y - tick}, {place.x, y}, {place.x + width, y}, {place.x + width, y - tick}}, line_width, ink});
  drawing.shapes.emplace_back(
      Text{{place.x + 0.5 * width, y - tick}, shortest_decimal(length_m) + " m", text_height, Alignment::centre, ink});
}

void add_north_arrow(Drawing& drawing, PagePoint tip) {
  const double foot = tip.y + arrow_height;
  drawing.shapes.emplace_back(
      Polygon{{tip, {tip.x + arrow_half_width, foot}, {tip.x, foot - 7.0}, {tip.x - arrow_half_width, foot}}, ink});
  drawing.shapes.emplace_back(Text{{tip.x, foot + text_height}, "N", text_height, Alignment::centre, ink});
}

}  // namespace farlod
