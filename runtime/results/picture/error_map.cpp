// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/error_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "results/picture/picture.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

constexpr Colour dark_outline_colour{64, 64, 68}, pale_outline_colour{176, 176, 182}, nothing{255, 255, 255};
constexpr std::uint8_t darkest_grey = 120, lightest_grey = 232;
constexpr double left = 24.0, title_base = 46.0, subtitle_base = 74.0;
constexpr double smallest_mark = 2.5, largest_mark = 8.0, mark_rim = 0.8;
constexpr double share_of_marks = 0.05;  // of the map's area, that marks may cover
constexpr double step_of_lines = 24.0;

PagePoint point_of(Pixel p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

bool has_values(const GreyMap& map) {
  return std::ranges::any_of(map.raster.values, [](float svf) { return !std::isnan(svf); });
}

Picture grey_picture_of(const PreviewRaster& raster) {
  Picture picture({raster.columns, raster.rows}, nothing);
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const float svf = raster.values[row * raster.columns + column];
      if (std::isnan(svf)) continue;
      const double share = std::clamp(static_cast<double>(svf), 0.0, 1.0);
      const auto grey = static_cast<std::uint8_t>(std::lround(darkest_grey + share * (lightest_grey - darkest_grey)));
      picture.set({column, row}, {grey, grey, grey});
    }
  return picture;
}

/// A triangle that points up for a positive sign, and down for a negative one.
Polygon triangle(PagePoint middle, double radius, double sign, Colour colour) {
  const double half = radius * std::numbers::sqrt3 / 2.0;
  return {{{middle.x, middle.y - sign * radius},
           {middle.x + half, middle.y + 0.5 * sign * radius},
           {middle.x - half, middle.y + 0.5 * sign * radius}},
          colour};
}

void add_mark(Drawing& drawing, PagePoint place, double radius, double error, Colour colour) {
  const double sign = error < 0.0 ? -1.0 : 1.0;
  // The rim of a triangle is twice as wide at its corners
  drawing.shapes.emplace_back(triangle(place, radius + 2.0 * mark_rim, sign, ink));
  drawing.shapes.emplace_back(triangle(place, radius, sign, colour));
}

double error_of(const VerifiedReceiver& r) { return static_cast<double>(r.svf) - static_cast<double>(r.exact); }

void add_marks(Drawing& drawing, const PreviewLayout& layout, const GreyMap& map, std::span<const VerifiedReceiver> receivers,
               double full) {
  std::vector<VerifiedReceiver> ordered(receivers.begin(), receivers.end());
  std::ranges::stable_sort(ordered, {}, [](const VerifiedReceiver& r) { return std::abs(error_of(r)); });
  const double area = static_cast<double>(layout.map_size.width * layout.map_size.height),
               count = static_cast<double>(std::max<std::size_t>(ordered.size(), 1)),
               radius = std::clamp(std::sqrt(share_of_marks * area / (std::numbers::pi * count)), smallest_mark, largest_mark);
  const PagePoint corner = point_of(layout.map);
  for (const VerifiedReceiver& r : ordered)
    add_mark(drawing,
             {corner.x + (r.p_projected.x - map.north_west_m.x) / map.raster.metres_per_pixel,
              corner.y + (map.north_west_m.y - r.p_projected.y) / map.raster.metres_per_pixel},
             radius, error_of(r), colour_of_error(error_of(r) / full));
}

void add_map(Drawing& drawing, const PreviewLayout& layout, const GreyMap& map, std::span<const Segment> outlines) {
  const auto [x, y] = point_of(layout.map);
  const double right = x + static_cast<double>(layout.map_size.width), bottom = y + static_cast<double>(layout.map_size.height);
  drawing.shapes.emplace_back(Image{layout.map, grey_picture_of(map.raster)});
  // Without values below them, marks would drown in dark outlines
  Segments lines{{}, 0.7, has_values(map) ? dark_outline_colour : pale_outline_colour};
  for (const auto& [a, b] : outlines) lines.segments.push_back({{x + a.x, y + a.y}, {x + b.x, y + b.y}});
  if (!lines.segments.empty()) drawing.shapes.emplace_back(std::move(lines));
  drawing.shapes.emplace_back(Line{{{x, y}, {right, y}, {right, bottom}, {x, bottom}, {x, y}}, 1.0, muted});
}

/// "+0.01", "0", "−0.01".
std::string signed_decimal(double value) {
  if (value == 0.0) return "0";
  return (value < 0.0 ? "−" : "+") + shortest_decimal(std::abs(value));
}

void add_colour_scale(Drawing& drawing, const PreviewLayout& layout, double full) {
  const std::size_t width = layout.colour_bar_size.width, height = layout.colour_bar_size.height;
  const auto share_at = [&](double y) { return 1.0 - 2.0 * y / static_cast<double>(height - 1); };
  Picture scale(layout.colour_bar_size, ink);
  for (std::size_t y = 0; y < height; ++y) scale.fill({0, y}, {width, 1}, colour_of_error(share_at(static_cast<double>(y))));
  drawing.shapes.emplace_back(Image{layout.colour_bar, std::move(scale)});
  const auto [x, top] = point_of(layout.colour_bar);
  for (const double share : {1.0, 0.5, 0.0, -0.5, -1.0}) {
    const double y = top + 0.5 + 0.5 * (1.0 - share) * static_cast<double>(height - 1), right = x + static_cast<double>(width);
    drawing.shapes.emplace_back(Line{{{right, y}, {right + 6.0, y}}, 1.5, ink});
    drawing.shapes.emplace_back(Text{
        {right + 10.0, y + half_digit_height * text_height}, signed_decimal(share * full), text_height, Alignment::left, ink});
  }
}

void add_legend(Drawing& drawing, PagePoint place, bool has_values) {
  const auto add_text = [&](double x, const std::string& words) {
    drawing.shapes.emplace_back(Text{{place.x + x, place.y + 12.0}, words, text_height, Alignment::left, ink});
  };
  const double middle = place.y + 8.0;
  add_mark(drawing, {place.x + 8.0, middle}, largest_mark, 1.0, colour_of_error(0.6));
  add_text(24.0, "too large");
  add_mark(drawing, {place.x + 120.0, middle - 2.0}, largest_mark, -1.0, colour_of_error(-0.6));
  add_text(136.0, "too small");
  if (!has_values) return;
  place.y += step_of_lines;
  drawing.shapes.emplace_back(box(place, 16.0, 14.0, {darkest_grey, darkest_grey, darkest_grey}));
  drawing.shapes.emplace_back(box({place.x + 16.0, place.y}, 16.0, 14.0, {lightest_grey, lightest_grey, lightest_grey}));
  add_text(40.0, "values, 0 to 1");
  drawing.shapes.emplace_back(box({place.x + 160.0, place.y}, 16.0, 14.0, ink));
  drawing.shapes.emplace_back(box({place.x + 161.0, place.y + 1.0}, 14.0, 12.0, nothing));
  add_text(184.0, "no data");
}

void add_statistics(Drawing& drawing, PagePoint place, const ErrorSummary& errors) {
  const auto number = [](double value) { return fmt::format("{:.5f}", value); };
  // As it is read: nothing has no sign
  const bool has_sign = number(std::abs(errors.bias)) != number(0.0);
  const std::string bias = (!has_sign ? "" : errors.bias < 0.0 ? "−" : "+") + number(std::abs(errors.bias));
  for (const std::string& words : {"mean |error| " + number(errors.mean_abs_error) + ", bias " + bias,
                                   "99 % within " + number(errors.p99_abs_error) + ", largest " + number(errors.max_abs_error)}) {
    drawing.shapes.emplace_back(Text{place, words, text_height, Alignment::left, ink});
    place.y += step_of_lines;
  }
}

void add_heading(Drawing& drawing, const ErrorSummary& errors, const ErrorMapCaption& caption) {
  drawing.shapes.emplace_back(Text{{left, title_base}, drawing.title, title_height, Alignment::left, ink});
  drawing.shapes.emplace_back(
      Text{{left, subtitle_base},
           fmt::format("Value less exact, at {} random receivers ({} rays each). {}", errors.count, errors.rays, caption.crs),
           text_height,
           Alignment::left,
           muted});
}

Box2d box_around(std::span<const VerifiedReceiver> receivers, const Box2d& otherwise) {
  if (receivers.empty()) return otherwise;
  Box2d around{{receivers[0].p_projected.x, receivers[0].p_projected.y},
               {receivers[0].p_projected.x, receivers[0].p_projected.y}};
  for (const VerifiedReceiver& r : receivers) {
    around.low = {std::min(around.low.x, r.p_projected.x), std::min(around.low.y, r.p_projected.y)};
    around.high = {std::max(around.high.x, r.p_projected.x), std::max(around.high.y, r.p_projected.y)};
  }
  constexpr double margin_share = 0.04, least_margin_m = 20.0;
  const double margin_m =
      std::max(margin_share * std::max(around.high.x - around.low.x, around.high.y - around.low.y), least_margin_m);
  return {around.low - Point2d{margin_m, margin_m}, around.high + Point2d{margin_m, margin_m}};
}

}  // namespace

GreyMap map_around(std::span<const VerifiedReceiver> receivers, const Box2d& otherwise) {
  const Box2d part = box_around(receivers, otherwise);
  const double width_m = part.high.x - part.low.x, height_m = part.high.y - part.low.y;
  const double step_m = std::max(width_m, height_m) / static_cast<double>(wished_preview_edge);
  const auto pixels = [&](double length_m) {
    return std::max<std::size_t>(static_cast<std::size_t>(std::lround(length_m / step_m)), 1);
  };
  GreyMap map{{part.low.x, part.high.y}, {pixels(width_m), pixels(height_m), step_m, {}}};
  map.raster.values.assign(map.raster.columns * map.raster.rows, std::numeric_limits<float>::quiet_NaN());
  return map;
}

double error_of_full_colour(const ErrorSummary& errors) {
  double power = 0.0001;
  while (true) {
    for (const double digit : {1.0, 2.0, 5.0})
      if (digit * power >= errors.p99_abs_error) return digit * power;
    power *= 10.0;
  }
}

Drawing draw_error_map(const GreyMap& map, std::span<const Segment> outlines, std::span<const VerifiedReceiver> receivers,
                       const ErrorSummary& errors, const ErrorMapCaption& caption) {
  PreviewLayout layout = layout_with_footer({map.raster.columns, map.raster.rows});
  const PagePoint footer = point_of(layout.footer);
  layout.picture.height += static_cast<std::size_t>(2.5 * step_of_lines);
  Drawing drawing{layout.picture, "Errors of " + caption.quantity + " against exact"};
  add_heading(drawing, errors, caption);
  add_map(drawing, layout, map, outlines);
  const double full = error_of_full_colour(errors);
  add_marks(drawing, layout, map, receivers, full);
  add_colour_scale(drawing, layout, full);
  add_scale_bar(drawing, footer, map.raster.metres_per_pixel, map.raster.columns);
  add_legend(drawing, {footer.x + 230.0, footer.y + 14.0}, has_values(map));
  add_statistics(drawing, {footer.x, footer.y + 14.0 + 3.0 * step_of_lines}, errors);
  add_north_arrow(drawing, {point_of(layout.colour_bar).x + 48.0, footer.y - 4.0});
  return drawing;
}

}  // namespace farlod
