// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "farlod/raster.hpp"

namespace farlod {

/// The pixels of a raster file, and whether it says its CRS.
struct RasterGrid {
  RasterPlan plan;
  bool says_crs = false;
};

/// Throws PointsError where the file cannot be read, its pixels are no squares or do not lie north up, or its CRS is not that of
/// the package: its corners would lie elsewhere, by more than a hundredth of a pixel.
[[nodiscard]] RasterGrid read_raster_grid_gdal(const std::filesystem::path& file, const std::string& package_crs_wkt);

}  // namespace farlod
