// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/raster_preview.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "results/picture/building_plan.hpp"
#include "results/picture/map_legend.hpp"
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
constexpr double tick_width = 1.5, tick_length = 6.0;
constexpr double page_margin_of_map = 24.0, first_line_of_title = page_margin_of_map + title_height;

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
    if (!has_no_value(raster.values[n]) || (!background.is_landmark.empty() && background.is_landmark[n])) continue;
    const bool is_covered = !background.is_covered.empty() && background.is_covered[n];
    (is_covered ? greys.of_buildings : greys.others) = true;
    const bool is_lit = !background.shading.empty() && std::abs(background.shading[n] - 1.0F) > visible_light;
    greys.are_lit = greys.are_lit || (is_lit && !is_covered);
  }
  return greys;
}

/// How much of the ground's light is seen in its grey, which must stay apart from that of buildings.
constexpr float share_of_grey = 0.25F;

Colour grey_of(const PlanBackground& background, std::size_t pixel) {
  if (!background.is_covered.empty() && background.is_covered[pixel]) return covered_grey;
  const float light = background.shading.empty() ? 1.0F : background.shading[pixel];
  return lit(no_value_grey, 1.0F + share_of_grey * (light - 1.0F));
}

/// Whether a pixel of the landmark lies near its edge.
bool is_at_edge(const std::vector<bool>& is_landmark, PixelSize map, Pixel pixel) {
  constexpr std::size_t rim = 2;
  if (pixel.x < rim || pixel.y < rim || pixel.x + rim >= map.width || pixel.y + rim >= map.height) return true;
  const std::size_t n = pixel.y * map.width + pixel.x;
  return !is_landmark[n - rim] || !is_landmark[n + rim] || !is_landmark[n - rim * map.width] || !is_landmark[n + rim * map.width];
}

/// Whether a landmark is asked for, and a place sees nothing of it.
bool sees_no_landmark(const RasterFrame& frame, float value) { return !frame.landmark.empty() && value == 0.0F; }

Colour colour_of_value(const RasterFrame& frame, const ValueScale& scale, float value) {
  return sees_no_landmark(frame, value) ? unseen_colour : scale.colour_of(static_cast<double>(value));
}

Picture map_of(const PreviewRaster& raster, const ValueScale& scale, const PlanBackground& background, const RasterFrame& frame) {
  Picture map({raster.columns, raster.rows}, no_value_grey);
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const std::size_t n = row * raster.columns + column;
      const float value = raster.values[n];
      const bool is_landmark = !background.is_landmark.empty() && background.is_landmark[n] &&
                               (has_no_value(value) || is_at_edge(background.is_landmark, map.size(), {column, row}));
      map.set({column, row}, is_landmark           ? landmark_colour
                             : has_no_value(value) ? grey_of(background, n)
                                                   : colour_of_value(frame, scale, value));
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

std::vector<LegendEntry> legend_of(const PreviewRaster& raster, const PlanBackground& background, const RasterFrame& frame) {
  using Sign = LegendEntry::Sign;
  const Greys greys = greys_of(raster, background);
  std::vector<LegendEntry> entries;
  if (std::ranges::find(background.is_landmark, true) != background.is_landmark.end())
    entries.push_back({Sign::box, landmark_colour, "landmark " + frame.landmark});
  if (std::ranges::any_of(raster.values, [&](float value) { return sees_no_landmark(frame, value); }))
    entries.push_back({Sign::box, unseen_colour, "nothing of it is seen"});
  if (greys.of_buildings) entries.push_back({Sign::box, covered_grey, "buildings"});
  if (greys.others) entries.push_back({Sign::box, no_value_grey, frame.why_no_value.empty() ? "no data" : frame.why_no_value});
  if (!background.outlines.empty()) entries.push_back({Sign::line, outline_colour, "roofs"});
  if (greys.are_lit) entries.push_back({Sign::none, {}, "Ground without data lit from the north-west"});
  return entries;
}

/// What is large enough to be seen has no ring.
void add_ring_around_landmark(Drawing& drawing, const PreviewLayout& layout, const PlanBackground& background) {
  constexpr double seen_edge = 24.0, ring_radius = 14.0;
  PagePoint low{static_cast<double>(layout.map_size.width), static_cast<double>(layout.map_size.height)}, high{};
  for (std::size_t n = 0; n < background.is_landmark.size(); ++n) {
    if (!background.is_landmark[n]) continue;
    const std::size_t row = n / layout.map_size.width;
    const auto x = static_cast<double>(n % layout.map_size.width), y = static_cast<double>(row);
    low = {std::min(low.x, x), std::min(low.y, y)};
    high = {std::max(high.x, x + 1.0), std::max(high.y, y + 1.0)};
  }
  if (high.x < low.x || std::max(high.x - low.x, high.y - low.y) > seen_edge) return;
  const auto [left, top] = page_point_of(layout.map);
  add_ring(drawing, {left + 0.5 * (low.x + high.x), top + 0.5 * (low.y + high.y)}, ring_radius, landmark_colour);
}

void add_outlines(Drawing& drawing, const PreviewLayout& layout, const PreviewRaster& raster, const PlanBackground& background) {
  const auto [left, top] = page_point_of(layout.map);
  // A wider line would hide most of a pixel that the screen shows by few of its own
  constexpr double share_of_pixel = 0.14, widest = 0.7;
  Segments lines{{}, std::min(share_of_pixel * static_cast<double>(raster.enlarged_by), widest), outline_colour};
  for (const auto& [a, b] : background.outlines) lines.segments.push_back({{left + a.x, top + a.y}, {left + b.x, top + b.y}});
  if (!lines.segments.empty()) drawing.shapes.emplace_back(std::move(lines));
}

/// Returns where the next line stands.
double add_lines(Drawing& drawing, const std::vector<std::string>& lines, double y, double height, double step, Colour colour) {
  for (const std::string& words : lines) {
    drawing.shapes.emplace_back(Text{{page_margin_of_map, y}, words, height, Alignment::left, colour});
    y += step;
  }
  return y;
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

Drawing draw_preview(const PreviewRaster& raster, const RasterFrame& frame, const PlanBackground& background) {
  const ValueScale scale = drawn_scale(raster, frame);
  const PixelSize map{raster.columns, raster.rows};
  const auto title = in_lines(scale.title, title_height, heading_width(map)),
             subtitle = in_lines(subtitle_of(frame, scale), text_height, heading_width(map));
  const auto legend = legend_in_rows(legend_of(raster, background, frame), legend_width(map));
  const bool is_beyond_map = !scale.unit.empty() && std::ranges::any_of(subtitle, [&](const std::string& line) {
    return width_of_words(line, text_height) > static_cast<double>(map.width);
  });
  const PreviewLayout layout = preview_layout(map, {title.size(), subtitle.size(), legend.size(), is_beyond_map});
  Drawing drawing{layout.picture, scale.title};
  const double below = add_lines(drawing, title, first_line_of_title, title_height, line_of_title, ink);
  add_lines(drawing, subtitle, below, text_height, line_of_subtitle, muted);
  drawing.shapes.emplace_back(Image{layout.map, map_of(raster, scale, background, frame)});
  add_outlines(drawing, layout, raster, background);
  add_ring_around_landmark(drawing, layout, background);
  add_colour_bar(drawing, layout, scale);
  add_scale_bar(drawing, page_point_of(layout.footer), raster.metres_per_pixel, raster.columns);
  add_legend_rows(drawing, page_point_of(layout.legend), legend);
  add_north_arrow(drawing, page_point_of(layout.north_arrow));
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
  if (frame_.package != nullptr && !frame_.landmark.empty())
    background.is_landmark = plan_of_building(*frame_.package, frame_.landmark, plan);
  write_drawing(draw_preview(raster, frame_, background), path_);
}

std::uint64_t PreviewWriter::bytes_for(const RasterFrame& frame) {
  return ScreenFit::bytes_for(frame) + bytes_of_largest_preview + (frame.package != nullptr ? bytes_of_largest_background : 0) +
         bytes_to_write_drawing(std::uint64_t{longest_preview_edge} * longest_preview_edge);
}

}  // namespace farlod
