// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "results/raster/raster_writer.hpp"

namespace farlod {

/// Writes a GeoTIFF: one band of 32-bit floats named for the quantity (three with bounds), north up, with the raster's CRS.
/// Pixels without data hold NaN, which the file declares as no data. The file is tiled and compressed; its tiles lie in the order
/// in which they were written.
class GeotiffWriter : public RasterWriter {
 public:
  /// Throws OutputError, as do the other functions.
  GeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path);
  ~GeotiffWriter() override;
  void write(const RasterTile& tile) override;
  void commit() override;
  /// Tiles that wait for their compression or for those before them. A run of one thread writes each tile at once.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
