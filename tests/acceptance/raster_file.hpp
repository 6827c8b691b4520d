// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::acceptance {

/// A raster as another program sees it.
struct RasterFile {
  std::size_t columns = 0, rows = 0;
  double step_m = 0.0;
  Point2d north_west;
  std::optional<int> epsg;
  std::vector<std::optional<double>> values;  ///< row by row from the north-west; empty where there is no data

  [[nodiscard]] Point2d centre_of(std::size_t n) const;
  /// The value of the pixel that holds a place; fails the test when the raster does not reach it.
  [[nodiscard]] std::optional<double> at(Point2d p) const;
};

/// One of its bands, counted from 1, and of a ZIP file, a folder for SOLWEIG or a Zarr group its svf; and the names of all of
/// them.
[[nodiscard]] RasterFile read_raster(const std::filesystem::path& file, int band = 1);
[[nodiscard]] std::vector<std::string> band_names(const std::filesystem::path& file);

/// An array of bytes, as NumPy stores it in an .npz file.
struct BytesArray {
  std::size_t rows = 0, columns = 0, depth = 0;
  std::string bytes;

  [[nodiscard]] int at(std::size_t pixel, std::size_t n) const { return static_cast<unsigned char>(bytes.at(pixel * depth + n)); }
};
[[nodiscard]] BytesArray read_array(const std::filesystem::path& npz_file, const std::string& name);

}  // namespace farlod::acceptance
