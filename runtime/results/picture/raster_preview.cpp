// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/raster_preview.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "results/picture/picture.hpp"
#include "results/picture/value_scale.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

constexpr std::size_t divide_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

std::size_t longer_edge(const RasterFrame& frame) { return std::max({frame.columns, frame.rows, std::size_t{1}}); }

PreviewRaster enlarged(const PreviewRaster& raster, std::size_t factor) {
  PreviewRaster result{
      raster.columns * factor, raster.rows * factor, raster.metres_per_pixel / static_cast<double>(factor), {}, factor};
  result.values.reserve(result.columns * result.rows);
  for (std::size_t row = 0; row < result.rows; ++row)
    for (std::size_t column = 0; column < result.columns; ++column)
      result.values.push_back(raster.values[row / factor * raster.columns + column / factor]);
  return result;
}

constexpr Colour outline_colour{24, 24, 28};
constexpr double outline_width = 0.7, tick_width = 1.5, tick_length = 6.0;
constexpr std::size_t margin = 24, gap = 16, heading_height = 50;
constexpr PixelSize legend_size{96, 280};
constexpr std::size_t colour_bar_width = 28, footer_height = 48;
constexpr std::size_t narrowest_content = 560;       // the longest title must fit
constexpr double letter_width = 0.53 * text_height;  // of a line of them, on average

/// The unit of the colours, what they are drawn for, the pixels that they stand for, and where north is up.
std::string subtitle_of(const RasterFrame& frame, const ValueScale& scale) {
  const std::string conditions = frame.conditions.empty() ? "" : ". " + frame.conditions;
  std::string text = scale.subtitle + conditions + ". Pixels of " + shortest_decimal(frame.step_m) + " m";
  if (frame.epsg) text += ", EPSG:" + std::to_string(*frame.epsg);
  return text;
}

ValueScale drawn_scale(const PreviewRaster& raster, const RasterFrame& frame) {
  double max_value = 0.0;
  for (const float value : raster.values)
    if (std::isfinite(value)) max_value = std::max(max_value, static_cast<double>(value));
  return scale_of(frame.bands[frame.drawn_band], max_value);
}

PagePoint page_point_of(Pixel p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

bool has_no_value(float value) { return std::isnan(value); }

/// Which greys a map has, and whether the ground's light is seen in any.
struct Greys {
  bool of_buildings = false, others = false, are_lit = false;
};

Greys greys_of(const PreviewRaster& raster, const PlanBackground& background) {
  Greys greys;
  for (std::size_t n = 0; n < raster.values.size(); ++n) {
    if (!has_no_value(raster.values[n])) continue;
    const bool is_covered = !background.is_covered.empty() && background.is_covered[n];
    (is_covered ? greys.of_buildings : greys.others) = true;
    const bool is_lit = !background.shading.empty() && std::abs(background.shading[n] - 1.0F) > visible_light;
    greys.are_lit = greys.are_lit || (is_lit && !is_covered);
  }
  return greys;
}

Colour grey_of(const PlanBackground& background, std::size_t pixel) {
  if (!background.is_covered.empty() && background.is_covered[pixel]) return covered_grey;
  const float light = background.shading.empty() ? 1.0F : background.shading[pixel];
  return lit(no_value_grey, 1.0F + share_of_grey * (light - 1.0F));
}

Picture map_of(const PreviewRaster& raster, const ValueScale& scale, const PlanBackground& background) {
  Picture map({raster.columns, raster.rows}, no_value_grey);
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const std::size_t n = row * raster.columns + column;
      const float value = raster.values[n];
      map.set({column, row}, has_no_value(value) ? grey_of(background, n) : scale.colour_of(static_cast<double>(value)));
    }
  return map;
}

Picture colour_scale_of(PixelSize size, const ValueScale& scale) {
  Picture colours(size, ink);
  for (std::size_t y = 0; y < size.height; ++y) {
    const double share = 1.0 - static_cast<double>(y) / static_cast<double>(size.height - 1);
    colours.fill({0, y}, {size.width, 1}, scale.colour_of(share * scale.end));
  }
  return colours;
}

void add_colour_bar(Drawing& drawing, const PreviewLayout& layout, const ValueScale& scale) {
  drawing.shapes.emplace_back(Image{layout.colour_bar, colour_scale_of(layout.colour_bar_size, scale)});
  const auto [left, top] = page_point_of(layout.colour_bar);
  const double right = left + static_cast<double>(layout.colour_bar_size.width);
  drawing.shapes.emplace_back(Text{{left, top - 6.0}, scale.unit, text_height, Alignment::left, ink});
  for (const double tick : scale.ticks()) {
    const double y = top + 0.5 + (1.0 - tick / scale.end) * static_cast<double>(layout.colour_bar_size.height - 1);
    drawing.shapes.emplace_back(Line{{{right, y}, {right + tick_length, y}}, tick_width, ink});
    drawing.shapes.emplace_back(Text{{right + tick_length + 4.0, y + half_digit_height * text_height},
                                     tick_text(tick, scale.step()),
                                     text_height,
                                     Alignment::left,
                                     ink});
  }
}

/// A box of a grey and its meaning; returns where the next one stands.
PagePoint add_grey_legend(Drawing& drawing, PagePoint place, Colour grey, const std::string& words) {
  constexpr double away = 36.0;
  constexpr double edge = 14.0, rim = 1.0;
  drawing.shapes.emplace_back(box(place, edge, edge, muted));
  drawing.shapes.emplace_back(box({place.x + rim, place.y + rim}, edge - 2.0 * rim, edge - 2.0 * rim, grey));
  drawing.shapes.emplace_back(Text{{place.x + edge + 8.0, place.y + edge - 2.0}, words, text_height, Alignment::left, ink});
  return {place.x + away + std::ceil(letter_width * static_cast<double>(words.size())), place.y};
}

void add_legend(Drawing& drawing, PagePoint place, const PlanBackground& background, const Greys& greys,
                const std::string& why_no_value) {
  PagePoint next = place;
  if (greys.of_buildings) next = add_grey_legend(drawing, next, covered_grey, "buildings");
  if (greys.others) next = add_grey_legend(drawing, next, no_value_grey, why_no_value.empty() ? "no data" : why_no_value);
  if (!background.outlines.empty()) {
    const double y = next.y + 7.5;
    drawing.shapes.emplace_back(Line{{{next.x, y}, {next.x + 22.0, y}}, outline_width, outline_colour});
    drawing.shapes.emplace_back(Text{{next.x + 30.0, next.y + 12.0}, "roofs", text_height, Alignment::left, ink});
  }
  if (greys.are_lit)
    drawing.shapes.emplace_back(
        Text{{place.x, place.y + 32.0}, "Ground without data lit from the north-west", text_height, Alignment::left, muted});
}

void add_outlines(Drawing& drawing, const PreviewLayout& layout, const PlanBackground& background) {
  const auto [left, top] = page_point_of(layout.map);
  Segments lines{{}, outline_width, outline_colour};
  for (const auto& [a, b] : background.outlines) lines.segments.push_back({{left + a.x, top + a.y}, {left + b.x, top + b.y}});
  if (!lines.segments.empty()) drawing.shapes.emplace_back(std::move(lines));
}

}  // namespace

ScreenFit::ScreenFit(const RasterFrame& frame)
    : frame_(frame),
      pixels_per_square_(divide_up(longer_edge(frame), longest_preview_edge)),
      columns_(divide_up(frame.columns, pixels_per_square_)),
      rows_(divide_up(frame.rows, pixels_per_square_)),
      sums_(columns_ * rows_),
      answers_(columns_ * rows_) {}

void ScreenFit::add(const RasterTile& tile) {
  const std::span<const float> values = farlod::bands_of(tile)[frame_.drawn_band];
  const std::size_t columns = pixels_of_tile(tile.place.column, frame_.columns);
  for (std::size_t row = 0; row < pixels_of_tile(tile.place.row, frame_.rows); ++row) {
    const std::size_t first = (tile.place.row * raster_tile_edge + row) / pixels_per_square_ * columns_;
    for (std::size_t column = 0; column < columns; ++column) {
      const float value = values[row * raster_tile_edge + column];
      if (std::isnan(value)) continue;
      const std::size_t square = first + (tile.place.column * raster_tile_edge + column) / pixels_per_square_;
      sums_[square] += static_cast<double>(value);
      ++answers_[square];
    }
  }
}

float ScreenFit::mean_of_square(std::size_t column, std::size_t row) const {
  const std::size_t width = std::min(pixels_per_square_, frame_.columns - column * pixels_per_square_);
  const std::size_t height = std::min(pixels_per_square_, frame_.rows - row * pixels_per_square_);
  const std::size_t square = row * columns_ + column;
  if (answers_[square] == 0 || 2 * std::size_t{answers_[square]} < width * height) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(sums_[square] / answers_[square]);
}

PreviewRaster ScreenFit::preview() const {
  PreviewRaster result{columns_, rows_, frame_.step_m * static_cast<double>(pixels_per_square_), {}};
  result.values.reserve(sums_.size());
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column) result.values.push_back(mean_of_square(column, row));
  return enlarged(result, std::max(wished_preview_edge / std::max({columns_, rows_, std::size_t{1}}), std::size_t{1}));
}

std::size_t ScreenFit::bytes_for(const RasterFrame& frame) {
  const std::size_t square = divide_up(longer_edge(frame), longest_preview_edge);
  return divide_up(frame.columns, square) * divide_up(frame.rows, square) * (sizeof(double) + sizeof(std::uint32_t));
}

PreviewLayout preview_layout(PixelSize map_size, std::size_t letters) {
  constexpr std::size_t below_long_heading = 12;  // the unit stands above the colours, and must not touch the heading
  const auto heading = static_cast<std::size_t>(letter_width * static_cast<double>(letters));
  PreviewLayout layout;
  layout.map = {margin, margin + heading_height + gap + (heading > map_size.width ? below_long_heading : 0)};
  layout.map_size = map_size;
  // The scale stands beside its map, however narrow that is
  layout.colour_bar = {margin + map_size.width + gap, layout.map.y};
  layout.colour_bar_size = {colour_bar_width, std::min(std::max(map_size.height, legend_size.height / 2), legend_size.height)};
  layout.footer = {margin, layout.map.y + std::max(map_size.height, layout.colour_bar_size.height) + gap};
  layout.picture = {margin + std::max({map_size.width + gap + legend_size.width, narrowest_content, heading}) + margin,
                    layout.footer.y + footer_height + margin};
  return layout;
}

Drawing draw_preview(const PreviewRaster& raster, const RasterFrame& frame, const PlanBackground& background) {
  const ValueScale scale = drawn_scale(raster, frame);
  const std::string subtitle = subtitle_of(frame, scale);
  const PreviewLayout layout = preview_layout({raster.columns, raster.rows}, frame.conditions.empty() ? 0 : subtitle.size());
  Drawing drawing{layout.picture, scale.title};
  const double left = static_cast<double>(margin), top = static_cast<double>(margin);
  drawing.shapes.emplace_back(Text{{left, top + title_height}, drawing.title, title_height, Alignment::left, ink});
  drawing.shapes.emplace_back(
      Text{{left, top + static_cast<double>(heading_height)}, subtitle, text_height, Alignment::left, muted});
  drawing.shapes.emplace_back(Image{layout.map, map_of(raster, scale, background)});
  add_outlines(drawing, layout, background);
  add_colour_bar(drawing, layout, scale);
  const PagePoint footer = page_point_of(layout.footer);
  add_scale_bar(drawing, footer, raster.metres_per_pixel, raster.columns);
  add_legend(drawing, {footer.x + 230.0, footer.y + 14.0}, background, greys_of(raster, background), frame.why_no_value);
  const double right = static_cast<double>(layout.picture.width - margin);
  add_north_arrow(drawing, {right - 0.5 * static_cast<double>(legend_size.width), footer.y - 4.0});
  return drawing;
}

PreviewWriter::PreviewWriter(const RasterFrame& frame, std::filesystem::path path)
    : fit_(frame), frame_(frame), path_(std::move(path)) {}

void PreviewWriter::commit() {
  const PreviewRaster raster = fit_.preview();
  const RasterPlan plan{frame_.north_west_m, raster.metres_per_pixel, raster.columns, raster.rows};
  const bool has_gaps = std::ranges::any_of(raster.values, has_no_value);
  PlanBackground background =
      frame_.package != nullptr ? plan_background(*frame_.package, plan, frame_.threads, has_gaps) : PlanBackground{};
  background.is_covered = widened(background.is_covered, plan.columns, (raster.enlarged_by + 1) / 2);
  write_drawing(draw_preview(raster, frame_, background), path_);
}

std::uint64_t PreviewWriter::bytes_for(const RasterFrame& frame) {
  return ScreenFit::bytes_for(frame) + bytes_of_largest_preview + (frame.package != nullptr ? bytes_of_largest_background : 0) +
         bytes_to_write_drawing(std::uint64_t{longest_preview_edge} * longest_preview_edge);
}

}  // namespace farlod
