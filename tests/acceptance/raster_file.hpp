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

/// One of its bands, counted from 1, and of a ZIP file or a Zarr group its svf; and the names of all of them.
[[nodiscard]] RasterFile read_raster(const std::filesystem::path& file, int band = 1);
[[nodiscard]] std::vector<std::string> band_names(const std::filesystem::path& file);

}  // namespace farlod::acceptance
