// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "results/picture.hpp"
#include "results/preview_raster.hpp"
#include "results/sky_raster.hpp"

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

/// A length of 1, 2 or 5 times a power of ten, the longest that is not above `limit_m` (which is positive).
[[nodiscard]] double round_length_m(double limit_m);

/// Draws the raster as a map with a title, a colour scale from 0 to 1, a scale bar in metres and a north arrow.
[[nodiscard]] Picture draw_preview(const SkyRaster& raster);

/// Draws the raster and writes it as PNG. Throws OutputError.
void write_png_preview(const SkyRaster& raster, const std::filesystem::path& path);

}  // namespace farlod
