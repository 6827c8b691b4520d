// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "georeference/raster_reader.hpp"

namespace farlod::georeference {

/// A lattice of pixels of a raster: every `step`-th column and row from the first on.
struct PixelLattice {
  std::int64_t column = 0, row = 0;
  std::uint32_t step = 1;   ///< a power of two
  std::uint32_t nodes = 1;  ///< along either side
};

/// A raster of heights as it is, pixel by pixel in its own frame: a far terrain of 100 km needs few of them far away, and is
/// never resampled. Units, masks and stand-ins for no data are as for read_terrain.
class HeightSamples {
 public:
  /// A raster without a CRS is in `fallback_crs` or, if that is empty, in the output CRS. Throws InputError.
  HeightSamples(const TerrainFile& file, const std::string& fallback_crs, const Georeference& georeference, Report& report);
  HeightSamples(HeightSamples&&) noexcept;
  ~HeightSamples();

  [[nodiscard]] std::int64_t columns() const;
  [[nodiscard]] std::int64_t rows() const;
  /// Metres; NaN where the raster has none, and beyond its edges. Row by row. Returns a number that stands for no data though the
  /// raster does not declare it, if there is one. Throws InputError when the file is cut short.
  std::optional<double> read(const PixelLattice& lattice, std::span<float> height_m) const;
  /// Moves points from the frame of pixels (x: column, y: row; whole numbers are centres) to the city frame. Heights stay. What
  /// has no place there becomes infinite.
  void move_to_city(std::span<Point3d> points) const;
  /// And back.
  void move_to_pixels(std::span<Point3d> points) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod::georeference
