// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <utility>

#include "base/expects.hpp"
#include "base/lower_case.hpp"
#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "results/module.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

const DrawingFormats& drawing_formats() {
  static const auto& formats = *static_cast<const DrawingFormats*>(functions_of_module("farlod_cairo", "Cairo and Pango"));
  return formats;
}

/// Shortens the part [begin, end] of a line to where its coordinate, which goes by `step` from `from`, lies between two bounds.
/// Returns whether anything is left.
bool shorten(double from, double step, double low, double high, double& begin, double& end) {
  if (step == 0.0) return low <= from && from <= high;
  const double at_low = (low - from) / step, at_high = (high - from) / step;
  begin = std::max(begin, std::min(at_low, at_high));
  end = std::min(end, std::max(at_low, at_high));
  return begin <= end;
}

double side_of(PagePoint a, PagePoint b, PagePoint p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

bool covers(const PageTriangle& t, PagePoint p) {
  const double ab = side_of(t[0], t[1], p), bc = side_of(t[1], t[2], p), ca = side_of(t[2], t[0], p);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

constexpr double line_width = 1.5, tick = 6.0;
constexpr double arrow_height = 28.0, arrow_half_width = 9.0;
constexpr double longest_scale_bar = 200.0;

}  // namespace

void write_drawing(const Drawing& drawing, const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  FARLOD_EXPECTS(ending == ".png" || ending == ".svg" || ending == ".pdf");
  if (std::max(drawing.size.width, drawing.size.height) > longest_drawing_edge)
    throw OutputError(path, "the picture has more than " + std::to_string(longest_drawing_edge) + " pixels along an edge");
  const DrawingFormats& formats = drawing_formats();
  const DrawingFormats::BytesOf bytes_of = ending == ".png" ? formats.png : ending == ".svg" ? formats.svg : formats.pdf;
  const std::string bytes = bytes_of(drawing, path);
  write_atomically(path, [&bytes](std::ostream& file) { file << bytes; });
}

std::string png_of(const Drawing& drawing) { return drawing_formats().png(drawing, "a picture in memory"); }

std::optional<Segment> clipped(const Segment& segment, PagePoint upper_left, PagePoint lower_right) {
  // Liang and Barsky (1984)
  const PagePoint &a = segment.a, &b = segment.b;
  double begin = 0.0, end = 1.0;
  if (!shorten(a.x, b.x - a.x, upper_left.x, lower_right.x, begin, end) ||
      !shorten(a.y, b.y - a.y, upper_left.y, lower_right.y, begin, end))
    return std::nullopt;
  const auto at = [&](double share) { return PagePoint{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; };
  return Segment{at(begin), at(end)};
}

void for_each_pixel(const PageTriangle& triangle, PixelSize picture, const std::function<void(Pixel)>& visit) {
  if (side_of(triangle[0], triangle[1], triangle[2]) == 0.0) return;  // upright
  const auto [west, east] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
  const auto [top, bottom] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  const auto within = [](double at, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(size)));
  };
  for (std::size_t y = within(std::floor(top), picture.height); y < within(std::ceil(bottom), picture.height); ++y)
    for (std::size_t x = within(std::floor(west), picture.width); x < within(std::ceil(east), picture.width); ++x)
      if (covers(triangle, {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5})) visit({x, y});
}

Polygon disc(PagePoint middle, double radius, Colour colour) {
  constexpr int corners = 24;
  Polygon polygon{{}, colour};
  for (int n = 0; n < corners; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / corners;
    polygon.corners.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
  }
  return polygon;
}

void add_ring(Drawing& drawing, PagePoint middle, double radius, Colour colour) {
  constexpr Colour casing{255, 255, 255};
  for (const auto& [width, of] : {std::pair{3.5, casing}, {1.5, colour}}) {
    Line ring{disc(middle, radius, of).corners, width, of};
    ring.places.push_back(ring.places.front());
    drawing.shapes.emplace_back(std::move(ring));
  }
}

double round_length_m(double limit_m) {
  const double power = std::pow(10.0, std::floor(std::log10(limit_m)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= limit_m) return digit * power;
  return power;
}

void add_scale_bar(Drawing& drawing, PagePoint place, double metres_per_pixel, std::size_t map_width) {
  const double longest = std::min(longest_scale_bar, static_cast<double>(std::max<std::size_t>(map_width, 1)));
  const double length_m = round_length_m(longest * metres_per_pixel), width = length_m / metres_per_pixel;
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
