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
#include "pipeline/pack.hpp"
#include "tiles/ground.hpp"

namespace farlod::pipeline {

/// The pixels of a city that is a raster, which was read as it is; none of other cities, nor where they are no squares.
[[nodiscard]] std::optional<package::SurfacePixels> own_pixels_of(const ReadCity& city);
/// Whether a rough surface is left to readers as far as they can make it, and what becomes of it here. Not where all cells get
/// far maps.
[[nodiscard]] std::optional<tiles::SquaresOfReaders> squares_of_readers(const StageSettings& settings);
/// Writes the surface that these pixels make into a package's folder, and tells of it. Where the ground is rough for
/// certain, some of its `squares` are left to readers of the package; the pixels tell how many.
void write_heights(const std::filesystem::path& folder, const ReadCity& city, tiles::Ground& ground, double height_origin_m,
                   const std::optional<tiles::SquaresOfReaders>& squares, package::SurfacePixels& pixels);

}  // namespace farlod::pipeline
