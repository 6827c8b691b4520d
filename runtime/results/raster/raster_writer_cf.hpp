// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "results/netcdf_file.hpp"
#include "results/raster/raster_writer.hpp"

namespace farlod {

/// Writes a netCDF-4 file after the CF conventions, version 1.8: a variable of 32-bit floats for each band, over `y` (from the
/// north) and `x`, the centres of the pixels; `crs` is the grid mapping. Pixels without data hold NaN, which is the fill value.
/// Tiles are chunks, compressed as they come.
class CfRasterWriter : public RasterWriter {
 public:
  /// Throws OutputError, as do the other functions.
  CfRasterWriter(const RasterFrame& frame, const std::filesystem::path& path);
  ~CfRasterWriter() override;
  void write(const RasterTile& tile) override;
  void commit() override;
  /// The caches of chunks.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame) {
    // A chunk in the cache of each variable; one as it is filtered, and the pixels of a tile that lie inside
    return (frame.bands.size() + 3) * raster_tile_edge * raster_tile_edge * sizeof(float) + NetcdfFile::library_bytes;
  }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
