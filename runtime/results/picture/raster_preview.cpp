// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/raster_preview.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "results/picture/picture.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

constexpr std::size_t divide_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

std::size_t longer_edge(const RasterFrame& frame) { return std::max({frame.columns, frame.rows, std::size_t{1}}); }

PreviewRaster enlarged(const PreviewRaster& raster, std::size_t factor) {
  PreviewRaster result{raster.columns * factor, raster.rows * factor, raster.metres_per_pixel / static_cast<double>(factor), {}};
  result.svf.reserve(result.columns * result.rows);
  for (std::size_t row = 0; row < result.rows; ++row)
    for (std::size_t column = 0; column < result.columns; ++column)
      result.svf.push_back(raster.svf[row / factor * raster.columns + column / factor]);
  return result;
}

// Colours must stay those of the scale, nearly
constexpr float darkest = 0.6F, lightest = 1.25F;
/// Changes of lightness below this are not seen, nor are a few pixels.
constexpr float visible = 0.03F;
constexpr std::size_t pixels_for_one_that_shows = 100;

/// The ground's heights as a picture has them.
class Relief {
 public:
  Relief(const std::vector<float>& heights_m, const RasterPlan& plan) : heights_m_(heights_m), plan_(plan) {}

  /// Towards the east and the north, in metres a metre; level where the ground is unknown.
  [[nodiscard]] Point2d gradient(std::size_t column, std::size_t row) const {
    const std::size_t west = column - (column > 0 ? 1 : 0), east = std::min(column + 1, plan_.columns - 1);
    const std::size_t north = row - (row > 0 ? 1 : 0), south = std::min(row + 1, plan_.rows - 1);
    return {rise(at(west, row), at(east, row), east - west), rise(at(column, south), at(column, north), south - north)};
  }

 private:
  [[nodiscard]] double at(std::size_t column, std::size_t row) const {
    return static_cast<double>(heights_m_[row * plan_.columns + column]);
  }
  [[nodiscard]] double rise(double from_m, double to_m, std::size_t pixels) const {
    const double slope = (to_m - from_m) / (static_cast<double>(pixels) * plan_.step_m);
    return std::isfinite(slope) ? slope : 0.0;
  }

  const std::vector<float>& heights_m_;
  const RasterPlan& plan_;
};

/// Lambert's cosine law, compared with level ground.
float factor_of(Point2d gradient) {
  constexpr double up = std::numbers::sqrt2 / 2.0, west = 0.5, north = 0.5;  // of length 1: 45° high in the north-west
  const double light = (west * gradient.x - north * gradient.y + up) / std::sqrt(1.0 + dot(gradient, gradient));
  return std::clamp(static_cast<float>(light / up), darkest, lightest);
}

std::vector<Segment> outlines_of(const Package& package, const RasterPlan& plan, const RunSettings& run) {
  const double right = static_cast<double>(plan.columns), bottom = static_cast<double>(plan.rows);
  const Point2d north_west = plan.north_west_m;
  const Box2d part{{north_west.x, north_west.y - bottom * plan.step_m}, {north_west.x + right * plan.step_m, north_west.y}};
  const auto found = building_outlines(package, part, most_outlines, run);
  if (!found || found->typical_edge_m < smallest_building * plan.step_m) return {};
  const auto placed = [&](Point2d p) {
    return PagePoint{(p.x - north_west.x) / plan.step_m, (north_west.y - p.y) / plan.step_m};
  };
  std::vector<Segment> outlines;
  for (const PlanSegment& segment : found->segments)
    if (const auto seen = clipped({placed(segment.a), placed(segment.b)}, {0.0, 0.0}, {right, bottom})) outlines.push_back(*seen);
  return outlines;
}

constexpr Colour outline_colour{24, 24, 28};
constexpr double outline_width = 0.7, tick_width = 1.5, tick_length = 6.0;
constexpr std::size_t margin = 24, gap = 16, heading_height = 50;
constexpr PixelSize legend_size{96, 280};
constexpr std::size_t colour_bar_width = 28, footer_height = 48;
constexpr std::size_t narrowest_content = 560;  // the longest title must fit
constexpr int colour_ticks = 5;                 // at 0.0, 0.2, … 1.0

std::string title_of(const std::string& quantity) {
  if (quantity == "svf") return "Sky view factor (svf)";
  if (quantity == "svf_solid") return "Solid angle share of the sky (svf_solid)";
  return quantity;
}

/// The unit of the colours, the pixels that they stand for, and where north is up.
std::string subtitle_of(const RasterFrame& frame) {
  std::string text = "No unit: 0 hidden, 1 open sky. Pixels of " + shortest_decimal(frame.step_m) + " m";
  if (frame.epsg) text += ", EPSG:" + std::to_string(*frame.epsg);
  return text;
}

PagePoint page_point_of(Pixel p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

Picture map_of(const PreviewRaster& raster, const std::vector<float>& shading) {
  Picture map({raster.columns, raster.rows}, nodata_colour);
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const std::size_t n = row * raster.columns + column;
      const float svf = raster.svf[n];
      if (!std::isnan(svf)) map.set({column, row}, lit(colour_of_svf(svf), shading.empty() ? 1.0F : shading[n]));
    }
  return map;
}

Picture colour_scale_of(PixelSize size) {
  Picture scale(size, ink);
  for (std::size_t y = 0; y < size.height; ++y) {
    const double svf = 1.0 - static_cast<double>(y) / static_cast<double>(size.height - 1);
    scale.fill({0, y}, {size.width, 1}, colour_of_svf(svf));
  }
  return scale;
}

void add_colour_bar(Drawing& drawing, const PreviewLayout& layout) {
  drawing.shapes.emplace_back(Image{layout.colour_bar, colour_scale_of(layout.colour_bar_size)});
  const auto [left, top] = page_point_of(layout.colour_bar);
  const double right = left + static_cast<double>(layout.colour_bar_size.width);
  for (int n = 0; n <= colour_ticks; ++n) {
    const double svf = static_cast<double>(n) / colour_ticks;
    const double y = top + 0.5 + (1.0 - svf) * static_cast<double>(layout.colour_bar_size.height - 1);
    drawing.shapes.emplace_back(Line{{{right, y}, {right + tick_length, y}}, tick_width, ink});
    drawing.shapes.emplace_back(Text{{right + tick_length + 4.0, y + half_digit_height * text_height},
                                     svf_decimal(svf).substr(0, 3),
                                     text_height,
                                     Alignment::left,
                                     ink});
  }
}

void add_nodata_legend(Drawing& drawing, PagePoint place) {
  constexpr double edge = 14.0;
  drawing.shapes.emplace_back(box(place, edge, edge, nodata_colour));
  drawing.shapes.emplace_back(Text{{place.x + edge + 8.0, place.y + edge - 2.0}, "no data", text_height, Alignment::left, ink});
}

void add_background_legend(Drawing& drawing, PagePoint place, const PlanBackground& background) {
  if (!background.outlines.empty()) {
    const double y = place.y + 7.5;
    drawing.shapes.emplace_back(Line{{{place.x + 86.0, y}, {place.x + 108.0, y}}, outline_width, outline_colour});
    drawing.shapes.emplace_back(Text{{place.x + 116.0, place.y + 12.0}, "roofs", text_height, Alignment::left, ink});
  }
  if (!background.shading.empty())
    drawing.shapes.emplace_back(
        Text{{place.x, place.y + 32.0}, "Ground lit from the north-west", text_height, Alignment::left, muted});
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
  const std::size_t columns = pixels_of_tile(tile.place.column, frame_.columns);
  for (std::size_t row = 0; row < pixels_of_tile(tile.place.row, frame_.rows); ++row) {
    const std::size_t first = (tile.place.row * raster_tile_edge + row) / pixels_per_square_ * columns_;
    for (std::size_t column = 0; column < columns; ++column) {
      const float svf = tile.svf[row * raster_tile_edge + column];
      if (std::isnan(svf)) continue;
      const std::size_t square = first + (tile.place.column * raster_tile_edge + column) / pixels_per_square_;
      sums_[square] += svf;
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
  result.svf.reserve(sums_.size());
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column) result.svf.push_back(mean_of_square(column, row));
  return enlarged(result, std::max(wished_preview_edge / std::max({columns_, rows_, std::size_t{1}}), std::size_t{1}));
}

std::size_t ScreenFit::bytes_for(const RasterFrame& frame) {
  const std::size_t square = divide_up(longer_edge(frame), longest_preview_edge);
  return divide_up(frame.columns, square) * divide_up(frame.rows, square) * (sizeof(double) + sizeof(std::uint32_t));
}

std::vector<float> shading_of(const std::vector<float>& heights_m, const RasterPlan& plan) {
  const Relief relief(heights_m, plan);
  std::vector<float> shading;
  shading.reserve(heights_m.size());
  for (std::size_t row = 0; row < plan.rows; ++row)
    for (std::size_t column = 0; column < plan.columns; ++column) shading.push_back(factor_of(relief.gradient(column, row)));
  const auto shown = std::count_if(shading.begin(), shading.end(), [](float f) { return std::abs(f - 1.0F) > visible; });
  return static_cast<std::size_t>(shown) * pixels_for_one_that_shows >= shading.size() ? shading : std::vector<float>{};
}

PlanBackground plan_background(const Package& package, const RasterPlan& plan, std::size_t threads) {
  RunSettings run;
  run.threads = threads;
  PlanBackground background;
  background.outlines = outlines_of(package, plan, run);
  // Pixels of less than a centimetre, or of more than ten kilometres, show no relief
  if (0.01 <= plan.step_m && plan.step_m <= 10'000.0) background.shading = shading_of(ground_heights(package, plan, run), plan);
  return background;
}

PreviewLayout preview_layout(PixelSize map_size) {
  PreviewLayout layout;
  layout.map = {margin, margin + heading_height + gap};
  layout.map_size = map_size;
  const std::size_t map_column = std::max(map_size.width, narrowest_content - gap - legend_size.width);
  layout.colour_bar = {margin + map_column + gap, layout.map.y};
  layout.colour_bar_size = {colour_bar_width, std::min(std::max(map_size.height, legend_size.height / 2), legend_size.height)};
  layout.footer = {margin, layout.map.y + std::max(map_size.height, layout.colour_bar_size.height) + gap};
  layout.picture = {layout.colour_bar.x + legend_size.width + margin, layout.footer.y + footer_height + margin};
  return layout;
}

Drawing draw_preview(const PreviewRaster& raster, const RasterFrame& frame, const PlanBackground& background) {
  const PreviewLayout layout = preview_layout({raster.columns, raster.rows});
  Drawing drawing{layout.picture, title_of(frame.bands.front().name)};
  const double left = static_cast<double>(margin), top = static_cast<double>(margin);
  drawing.shapes.emplace_back(Text{{left, top + title_height}, drawing.title, title_height, Alignment::left, ink});
  drawing.shapes.emplace_back(
      Text{{left, top + static_cast<double>(heading_height)}, subtitle_of(frame), text_height, Alignment::left, muted});
  drawing.shapes.emplace_back(Image{layout.map, map_of(raster, background.shading)});
  add_outlines(drawing, layout, background);
  add_colour_bar(drawing, layout);
  const PagePoint footer = page_point_of(layout.footer);
  add_scale_bar(drawing, footer, raster.metres_per_pixel);
  const PagePoint legend{footer.x + 230.0, footer.y + 14.0};
  add_nodata_legend(drawing, legend);
  add_background_legend(drawing, legend, background);
  add_north_arrow(drawing, {page_point_of(layout.colour_bar).x + 0.5 * static_cast<double>(legend_size.width), footer.y - 4.0});
  return drawing;
}

PreviewWriter::PreviewWriter(const RasterFrame& frame, std::filesystem::path path)
    : fit_(frame), frame_(frame), path_(std::move(path)) {}

void PreviewWriter::commit() {
  const PreviewRaster raster = fit_.preview();
  const RasterPlan plan{frame_.north_west_m, raster.metres_per_pixel, raster.columns, raster.rows};
  const PlanBackground background =
      frame_.package != nullptr ? plan_background(*frame_.package, plan, frame_.threads) : PlanBackground{};
  write_drawing(draw_preview(raster, frame_, background), path_);
}

std::uint64_t PreviewWriter::bytes_for(const RasterFrame& frame) {
  return ScreenFit::bytes_for(frame) + bytes_of_largest_preview + (frame.package != nullptr ? bytes_of_largest_background : 0) +
         bytes_to_write_drawing(std::uint64_t{longest_preview_edge} * longest_preview_edge);
}

}  // namespace farlod
