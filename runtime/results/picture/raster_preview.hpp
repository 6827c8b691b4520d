// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "farlod/package.hpp"
#include "farlod/plan_view.hpp"
#include "farlod/raster.hpp"
#include "results/picture/drawing.hpp"
#include "results/raster/raster_writer.hpp"

namespace farlod {

/// A band of a raster at the size of a picture on a screen. NaN where there is no answer.
struct PreviewRaster {
  std::size_t columns = 0, rows = 0;
  double metres_per_pixel = 1.0;
  std::vector<float> values;    ///< row by row from the north
  std::size_t enlarged_by = 1;  ///< columns, and rows, that a pixel of the raster has
};

/// Neither edge of a preview is longer than this.
inline constexpr std::size_t longest_preview_edge = 2000;
/// Small rasters are enlarged towards this, by the largest whole factor that does not pass it.
inline constexpr std::size_t wished_preview_edge = 1000;

/// What the largest preview and the picture of it hold in memory: a float and three bytes a pixel. Enlarged ones hold the float
/// twice, and are at most a quarter as large.
inline constexpr std::size_t bytes_of_largest_preview = longest_preview_edge * longest_preview_edge * (sizeof(float) + 3);

/// Fits a raster to a screen: large ones are averaged over squares of whole pixels, small ones repeat each pixel a whole number
/// of times. A square without an answer in most of its pixels has none itself. Tiles come in any order, each once or not at all.
class ScreenFit {
 public:
  explicit ScreenFit(const RasterFrame& frame);
  void add(const RasterTile& tile);
  [[nodiscard]] PreviewRaster preview() const;
  /// What the sums over its squares hold in memory.
  [[nodiscard]] static std::size_t bytes_for(const RasterFrame& frame);

 private:
  [[nodiscard]] float mean_of_square(std::size_t column, std::size_t row) const;

  RasterFrame frame_;
  std::size_t pixels_per_square_;  ///< along an edge
  std::size_t columns_, rows_;     ///< of squares
  std::vector<double> sums_;
  std::vector<std::uint32_t> answers_;
};

/// What a map shows besides its values, so that a reader finds his way.
struct PlanBackground {
  /// Outlines of roofs, in pixels from the upper left corner of the map. None where there would be more than most_outlines, or
  /// where a building would be smaller than smallest_building pixels: they would hide the map.
  std::vector<Segment> outlines;
  /// Factors of the lightness of pixels without a value, row by row; empty where no ground rises visibly.
  std::vector<float> shading;
  /// Whether a building covers the pixel, row by row; empty where no pixel asks.
  std::vector<bool> is_covered = {};
};

/// With all pixels that lie so many columns or rows beside one that is covered, row by row: what has no value has its middle
/// covered, or most of it, and perhaps not the pixels at its edge.
[[nodiscard]] std::vector<bool> widened(const std::vector<bool>& is_covered, std::size_t columns, std::size_t by);

/// The greys of pixels without a value: of buildings, which have a roof there, and of all else.
inline constexpr Colour covered_grey = nodata_colour, no_value_grey{236, 236, 234};

inline constexpr std::size_t most_outlines = 100'000;
inline constexpr double smallest_building = 2.0;

/// Looks the background of a map up, whose pixels are those of the plan. Without pixels that have no value, it is outlines alone.
[[nodiscard]] PlanBackground plan_background(const Package& package, const RasterPlan& plan, std::size_t threads,
                                             bool has_pixels_without_value = true);

/// How a ground is lit from the north-west, at 45° above the horizon, by its heights: 1 where it is level or unknown, more where
/// it looks to the light. Empty when it is level everywhere, to the eye.
[[nodiscard]] std::vector<float> shading_of(const std::vector<float>& heights_m, const RasterPlan& plan);

/// What the background of the largest preview holds: two heights and shading of each pixel, outlines on the ground and
/// on the page.
inline constexpr std::size_t bytes_of_largest_background =
    longest_preview_edge * longest_preview_edge * 3 * sizeof(float) + most_outlines * 3 * (sizeof(PlanSegment) + sizeof(Segment));

/// Where the parts of a preview lie: the title above the map, the colour scale to its right, scale bar and legend below.
struct PreviewLayout {
  PixelSize picture;
  Pixel map;
  PixelSize map_size;
  Pixel colour_bar;
  PixelSize colour_bar_size;
  Pixel footer;
};

/// With room for so many letters in the second line of the heading.
[[nodiscard]] PreviewLayout preview_layout(PixelSize map_size, std::size_t letters = 0);

/// Draws a band of a raster (RasterFrame::drawn_band) as a map with a title, a colour scale, a scale bar in metres and a north
/// arrow. Pixels without a value are grey: those of buildings, and, lightened and darkened as the ground is lit, all others.
[[nodiscard]] Drawing draw_preview(const PreviewRaster& raster, const RasterFrame& frame, const PlanBackground& background = {});

/// Draws the raster and writes it as PNG, SVG or PDF, without bounds. What the frame's package knows of buildings and ground is
/// looked up by commit().
class PreviewWriter : public RasterWriter {
 public:
  PreviewWriter(const RasterFrame& frame, std::filesystem::path path);
  void write(const RasterTile& tile) override { fit_.add(tile); }
  void commit() override;
  /// The sums of the preview's pixels, and the picture that commit() draws.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame);

 private:
  ScreenFit fit_;
  RasterFrame frame_;
  std::filesystem::path path_;
};

}  // namespace farlod
