// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "results/raster_writer.hpp"

namespace farlod {

/// Writes a GeoTIFF: one band of 32-bit floats named for the quantity (three with bounds), north up, with the raster's CRS;
/// pixels without an answer are NaN, declared as no data. Tiled and compressed; tiles lie in the file in the order in which they
/// came.
class GeotiffWriter : public RasterWriter {
 public:
  /// Throws OutputError, as do the other functions.
  GeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path);
  ~GeotiffWriter() override;
  void write(const RasterTile& tile) override;
  void commit() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The same for a raster as a whole.
void write_geotiff(const SkyRaster& raster, const std::filesystem::path& path);

}  // namespace farlod
