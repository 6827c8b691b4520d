// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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

/// Which band of a raster is read, and how.
struct RasterReading {
  std::string band;         ///< its description; empty: `svf` where there is one, else the first
  std::string package_crs;  ///< into which the raster is brought; WKT
  std::uint32_t longest_side = 2048;
};

/// A band of a raster, in the CRS of a package. Rows are as in the file: the first is most often the northernmost.
struct RasterBand {
  std::string name;  ///< the description of the band, or "band 1"
  std::uint32_t width = 0, height = 0;
  std::uint64_t pixels_of_file = 0;
  /// East of the corner of pixel (column, row) = [0] + column·[1] + row·[2], north = [3] + column·[4] + row·[5].
  std::array<double, 6> projected_from_pixel{};
  std::vector<float> values = {};  ///< row by row; NaN where there is no data
};

/// Whether GDAL takes a file for a raster.
[[nodiscard]] bool is_raster_file(const std::filesystem::path& file);

/// Reads a band. A raster with a side of more than `longest_side` pixels is thinned: each pixel is the mean of those that it
/// covers. One in another CRS is warped, each pixel from the nearest; one that says no CRS is taken to be in that of the package.
/// Throws InputError.
[[nodiscard]] RasterBand read_raster_gdal(const std::filesystem::path& file, const RasterReading& reading);

}  // namespace farlod
