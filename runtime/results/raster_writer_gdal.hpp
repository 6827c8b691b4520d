// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "results/sky_raster.hpp"

namespace farlod {

/// Writes a GeoTIFF: one band of 32-bit floats named for the quantity, north up, with the raster's CRS; pixels without an
/// answer are NaN, declared as no data. Tiled and compressed. Throws OutputError.
void write_geotiff(const SkyRaster& raster, const std::filesystem::path& path);

}  // namespace farlod
