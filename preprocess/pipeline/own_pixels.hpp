// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "city/city_model.hpp"
#include "package/manifest.hpp"
#include "package/pixel_heights.hpp"
#include "pipeline/city_reading.hpp"

namespace farlod::pipeline {

/// The pixels of a city that is a raster, which was read as it is; none of other cities, nor where they are no squares.
[[nodiscard]] std::optional<package::SurfacePixels> own_pixels_of(const ReadCity& city);
/// The surface that these pixels make.
[[nodiscard]] PixelHeights heights_of(const TerrainRaster& raster, double height_origin_m);

/// SurfacePixels::walls: what has no height has no walls.
[[nodiscard]] std::uint64_t walls_of(const package::SurfacePixels& pixels, const PixelHeights& heights);
/// Writes them into a package's folder, and tells of them.
void write_heights(const std::filesystem::path& folder, const PixelHeights& heights, package::SurfacePixels& pixels);

}  // namespace farlod::pipeline
