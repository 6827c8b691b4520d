// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "results/raster/raster_writer.hpp"

namespace farlod {

/// Writes GeoTIFF files into a folder, of the surface that a package is, at the pixels of a raster as SOLWEIG of UMEP reads them:
///   dsm.tif            the highest solid surface, metres above sea level
///   dem.tif            the ground; not of a surface model, which knows no ground of its own
///   cdsm.tif tdsm.tif  tops and bottoms of crowns, metres above dsm.tif, to which UMEP adds them; 0 where there are none. Only
///   of a
///                      package with trees
///   wall_height.tif    wall_heights() of dsm.tif
///   wall_aspect.tif    wall_aspects() of dsm.tif
/// The frame has a package. Throws OutputError, and what plan_heights throws.
void write_surface_rasters(const RasterFrame& frame, const std::filesystem::path& folder);

/// What write_surface_rasters holds.
[[nodiscard]] std::uint64_t surface_rasters_bytes(const RasterFrame& frame);

}  // namespace farlod
