// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "farlod/plan_view.hpp"
#include "farlod/raster.hpp"
#include "results/picture/drawing.hpp"
#include "results/picture/plan_background.hpp"
#include "results/picture/preview_layout.hpp"
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

/// What the background of the largest preview holds: two heights and shading of each pixel, outlines on the ground and
/// on the page.
inline constexpr std::size_t bytes_of_largest_background =
    longest_preview_edge * longest_preview_edge * 3 * sizeof(float) + most_outlines * 3 * (sizeof(PlanSegment) + sizeof(Segment));

/// Draws a band of a raster (RasterFrame::drawn_band) as a map with a title, a colour scale, a scale bar in metres and a north
/// arrow. Pixels without a value are grey: those of buildings, and, lightened and darkened as the ground is lit, all others. The
/// building that receivers look for has a colour of its own; where it has values, its edge has it.
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
