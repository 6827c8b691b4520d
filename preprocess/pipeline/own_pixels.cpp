// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/own_pixels.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "tiles/pixel_steps.hpp"

namespace farlod::pipeline {

std::optional<package::SurfacePixels> own_pixels_of(const ReadCity& city) {
  const auto& raster = city.ground.terrain;
  if (!raster || raster->is_resampled || !city.located.city.buildings().empty() || raster->step_m.x != raster->step_m.y)
    return std::nullopt;
  const double step_m = raster->step_m.x;
  const Point2d middle = raster->node(0, raster->rows - 1) + city.located.georeference.origin_m;
  // Whole micrometres, as in the file: the frame's origin was subtracted, and is added again
  const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6; };
  return package::SurfacePixels{{rounded(middle.x - 0.5 * step_m), rounded(middle.y + 0.5 * step_m)},
                                step_m,
                                static_cast<std::uint32_t>(raster->columns),
                                static_cast<std::uint32_t>(raster->rows)};
}

PixelHeights heights_of(const TerrainRaster& raster, double height_origin_m) {
  const tiles::PixelSteps steps(raster);
  PixelHeights heights;
  heights.height_m.reserve(raster.height_m.size());
  heights.joined.reserve(raster.height_m.size());
  for (std::size_t row = 0, n = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column, ++n) {
      const auto& height_m = raster.height_m[n];
      heights.height_m.push_back(height_m ? static_cast<float>(*height_m - height_origin_m)
                                          : std::numeric_limits<float>::quiet_NaN());
      heights.joined.push_back(static_cast<std::uint8_t>((steps.joins_east(column, row) ? JoinedPixels::east : 0) |
                                                         (steps.joins_north(column, row) ? JoinedPixels::north : 0)));
    }
  return heights;
}

std::uint64_t walls_of(const package::SurfacePixels& pixels, const PixelHeights& heights) {
  std::uint64_t walls = 0;
  const auto count = [&](std::size_t n, std::size_t next, std::uint8_t side) {
    const bool have_heights = !std::isnan(heights.height_m[n]) && !std::isnan(heights.height_m[next]);
    if (have_heights && (heights.joined[n] & side) == 0) ++walls;
  };
  for (std::size_t row = 0, n = 0; row < pixels.rows; ++row)
    for (std::size_t column = 0; column < pixels.columns; ++column, ++n) {
      if (column + 1 < pixels.columns) count(n, n + 1, JoinedPixels::east);
      if (row + 1 < pixels.rows) count(n, n + pixels.columns, JoinedPixels::north);
    }
  return walls;
}

void write_heights(const std::filesystem::path& folder, const PixelHeights& heights, package::SurfacePixels& pixels) {
  pixels.heights = write_pixel_heights(folder, pixels, heights);
  pixels.walls = walls_of(pixels, heights);
}

}  // namespace farlod::pipeline
