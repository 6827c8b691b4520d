// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "results/raster/raster_writer.hpp"

namespace farlod {

/// Writes a folder after the Zarr specification, version 2, as xarray reads it (with _ARRAY_DIMENSIONS and consolidated metadata)
/// and as the CF conventions, version 1.8, want it: an array of 32-bit floats for each band, over `y` (from the north) and `x`,
/// the centres of the pixels; `crs` is the grid mapping. Tiles are chunks, compressed as they come; one that does not come is no
/// file.
class ZarrWriter : public RasterWriter {
 public:
  /// Throws OutputError, as do the other functions.
  ZarrWriter(const RasterFrame& frame, const std::filesystem::path& path);
  ~ZarrWriter() override;
  void write(const RasterTile& tile) override;
  void commit() override;
  /// A chunk of each array, which GDAL keeps until it gets the next, and that chunk compressed.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame) {
    return (2 * frame.bands.size() + 2) * raster_tile_edge * raster_tile_edge * sizeof(float);
  }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
