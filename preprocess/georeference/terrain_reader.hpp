// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "city/located_city.hpp"
#include "city/terrain_raster.hpp"
#include "farlod/box.hpp"
#include "georeference/georeference.hpp"

namespace farlod::georeference {

/// Where a raster of heights lies, as it says itself.
struct TerrainExtent {
  std::string crs_wkt;  ///< empty when the file does not say
  Box2d box;            ///< easting or longitude in x, over whole pixels
};

/// Throws InputError when the file is not a raster, or has no place on the map.
[[nodiscard]] TerrainExtent read_terrain_extent(const std::filesystem::path& file);

/// The frame of a city of which only a terrain or surface model is known: the raster's own CRS, or --crs, chosen by the
/// same rules as for buildings.
[[nodiscard]] Georeference georeference_of_terrain(const std::filesystem::path& file, const GeoreferenceSettings& settings);

/// Reads the heights of the ground from band 1 of any raster that GDAL reads.
///   (1) a north-up raster in the output CRS is taken as it is: its pixels' centres are the nodes
///   (2) any other is resampled into the output CRS, bilinear, at a comparable resolution
///   (3) what the file masks, or marks as no data, is empty; its scale and offset are applied
///   (4) heights are in metres: by the band's unit, else by the CRS's vertical or, if that is projected, horizontal unit
/// A raster without a CRS is in `fallback_crs`, or if that is empty, in the output CRS. Of a raster larger than
/// `wanted_city` only that part is read, and one pixel around it.
/// Throws InputError when the file cannot be read, or lies elsewhere than `wanted_city`.
[[nodiscard]] TerrainRaster read_terrain(const std::filesystem::path& file, const std::string& fallback_crs,
                                         const Georeference& georeference, std::optional<Box2d> wanted_city);

}  // namespace farlod::georeference
