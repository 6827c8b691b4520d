// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "results/picture/drawing.hpp"
#include "results/picture/map_ornaments.hpp"
#include "results/picture/plan_background.hpp"
#include "results/picture/preview_raster.hpp"
#include "results/raster/raster_writer.hpp"

namespace farlod {

/// Where the parts of a preview lie: the title above the map, the colour scale to its right, scale bar and legend below.
struct PreviewLayout {
  PixelSize picture;
  Pixel map;
  PixelSize map_size;
  Pixel colour_bar;
  PixelSize colour_bar_size;
  Pixel footer;
};

[[nodiscard]] PreviewLayout preview_layout(PixelSize map_size);

/// Draws a raster as a map with a title, a colour scale from 0 to 1, a scale bar in metres and a north arrow. Colours are
/// lightened and darkened as the ground is lit; level ground has those of the scale.
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
