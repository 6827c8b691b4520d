// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "results/raster/raster_writer.hpp"

namespace farlod {

/// Edge of a block of the file, in pixels: what readers fetch at a time.
inline constexpr std::size_t geotiff_block_edge = 512;

/// Writes a cloud-optimised GeoTIFF: bands of 32-bit floats with their names, units and definitions, north up, with the raster's
/// CRS and provenance. Pixels without data hold NaN, which the file declares as no data. Blocks are compressed; overviews are
/// averages over the pixels that have data. Until commit(), tiles wait in a file beside the result, four bytes a pixel and band:
/// the layout wants overviews before pixels, and blocks from the north-west on
/// (docs/decisions/0023-cloud-optimised-geotiff.md).
class GeotiffWriter : public RasterWriter {
 public:
  /// Throws OutputError, as do the other functions.
  GeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path);
  ~GeotiffWriter() override;
  void write(const RasterTile& tile) override;
  void commit() override;
  /// What commit() holds: GDAL's cache of blocks, its buffers for overviews, and blocks that are being compressed.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
