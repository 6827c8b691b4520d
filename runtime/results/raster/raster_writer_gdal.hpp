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
/// GDAL's cache of blocks while the file is copied. Its default, a twentieth of the machine's memory, is more than a copy from
/// one tile to the next has use for.
inline constexpr std::uint64_t geotiff_cache_bytes = 16 << 20;

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
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame) {
    // Measured on rasters of 3 to 26 million pixels, for which it is much the same
    constexpr std::uint64_t overview_bytes = 36 << 20;
    // A block as it came, and its compressed bytes, which may be as many; GDAL has one more in turn than it has threads
    const std::uint64_t bytes_of_block = 2 * geotiff_block_edge * geotiff_block_edge * sizeof(float) * frame.bands.size();
    return geotiff_cache_bytes + overview_bytes + (frame.threads == 1 ? 1 : frame.threads + 1) * bytes_of_block;
  }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
