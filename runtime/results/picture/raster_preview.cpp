// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/raster_preview.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "results/decimal.hpp"
#include "results/picture/bitmap_font.hpp"
#include "results/picture/colour_map.hpp"
#include "results/picture/png_writer.hpp"

namespace farlod {
namespace {

constexpr Colour paper{255, 255, 255}, ink{32, 32, 32};
constexpr TextStyle text_style{2, ink};
constexpr std::size_t margin = 24, gap = 16, line = 2, tick = 6;
constexpr std::size_t text_height = 18;
constexpr PixelSize legend_size{96, 280};
constexpr std::size_t colour_bar_width = 28;
constexpr std::size_t footer_height = 48, arrow_height = 28;
constexpr std::size_t narrowest_content = 560;  // the longest title must fit
constexpr double longest_scale_bar = 200.0;
constexpr int colour_ticks = 5;  // at 0.0, 0.2, … 1.0

std::string title_of(const std::string& quantity) {
  if (quantity == "svf") return "Sky view factor (svf)";
  if (quantity == "svf_solid") return "Solid angle share of the sky (svf_solid)";
  return quantity;
}

void draw_map(Picture& picture, const PreviewLayout& layout, const PreviewRaster& raster) {
  for (std::size_t row = 0; row < raster.rows; ++row) {
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const float svf = raster.svf[row * raster.columns + column];
      picture.set({layout.map.x + column, layout.map.y + row}, std::isnan(svf) ? nodata_colour : colour_of_svf(svf));
    }
  }
}

void draw_colour_bar(Picture& picture, const PreviewLayout& layout) {
  const auto [width, height] = layout.colour_bar_size;
  for (std::size_t y = 0; y < height; ++y) {
    const double svf = 1.0 - static_cast<double>(y) / static_cast<double>(height - 1);
    picture.fill({layout.colour_bar.x, layout.colour_bar.y + y}, {width, 1}, colour_of_svf(svf));
  }
  for (int n = 0; n <= colour_ticks; ++n) {
    const double svf = static_cast<double>(n) / colour_ticks;
    const auto down = static_cast<std::size_t>(std::lround((1.0 - svf) * static_cast<double>(height - line)));
    const Pixel place{layout.colour_bar.x + width, layout.colour_bar.y + down};
    picture.fill(place, {tick, line}, ink);
    draw_text(picture, {place.x + tick + 4, place.y - 6}, svf_decimal(svf).substr(0, 3), text_style);
  }
}

void draw_scale_bar(Picture& picture, Pixel place, double metres_per_pixel) {
  const double length_m = round_length_m(longest_scale_bar * metres_per_pixel);
  const auto width = static_cast<std::size_t>(std::lround(length_m / metres_per_pixel));
  const std::size_t y = place.y + text_height + 10;
  picture.fill({place.x, y}, {width, line}, ink);
  picture.fill({place.x, y - tick}, {line, tick + line}, ink);
  picture.fill({place.x + width - line, y - tick}, {line, tick + line}, ink);
  draw_text(picture, {place.x + 8, place.y}, shortest_decimal(length_m) + " m", text_style);
}

void draw_nodata_legend(Picture& picture, Pixel place) {
  const std::size_t edge = 14;
  picture.fill({place.x, place.y}, {edge, edge}, nodata_colour);
  draw_text(picture, {place.x + edge + 8, place.y}, "no data", text_style);
}

void draw_north_arrow(Picture& picture, Pixel tip) {
  for (std::size_t down = 0; down < arrow_height; ++down) {
    const std::size_t half = down / 3;
    picture.fill({tip.x - half, tip.y + down}, {2 * half + 1, 1}, ink);
  }
  const PixelSize letter = text_size("N", text_style);
  draw_text(picture, {tip.x - letter.width / 2, tip.y + arrow_height + 4}, "N", text_style);
}

}  // namespace

PreviewLayout preview_layout(PixelSize map_size) {
  PreviewLayout layout;
  layout.map = {margin, margin + text_height + gap};
  layout.map_size = map_size;
  const std::size_t map_column = std::max(map_size.width, narrowest_content - gap - legend_size.width);
  layout.colour_bar = {margin + map_column + gap, layout.map.y};
  layout.colour_bar_size = {colour_bar_width, std::min(std::max(map_size.height, legend_size.height / 2), legend_size.height)};
  layout.footer = {margin, layout.map.y + std::max(map_size.height, layout.colour_bar_size.height) + gap};
  layout.picture = {layout.colour_bar.x + legend_size.width + margin, layout.footer.y + footer_height + margin};
  return layout;
}

double round_length_m(double limit_m) {
  const double power = std::pow(10.0, std::floor(std::log10(limit_m)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= limit_m) return digit * power;
  return power;
}

Picture draw_preview(const PreviewRaster& raster, const std::string& quantity) {
  const PreviewLayout layout = preview_layout({raster.columns, raster.rows});
  Picture picture(layout.picture, paper);
  draw_text(picture, {margin, margin}, title_of(quantity), text_style);
  draw_map(picture, layout, raster);
  draw_colour_bar(picture, layout);
  draw_scale_bar(picture, layout.footer, raster.metres_per_pixel);
  draw_nodata_legend(picture, {layout.footer.x + 230, layout.footer.y + 14});
  draw_north_arrow(picture, {layout.colour_bar.x + legend_size.width / 2, layout.footer.y - 4});
  return picture;
}

PngPreviewWriter::PngPreviewWriter(const RasterFrame& frame, std::filesystem::path path)
    : fit_(frame), quantity_(frame.quantity), path_(std::move(path)) {}

void PngPreviewWriter::commit() { write_png(draw_preview(fit_.preview(), quantity_), path_); }

}  // namespace farlod
