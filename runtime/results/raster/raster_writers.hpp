// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "results/netcdf_file.hpp"
#include "results/raster/raster_writer.hpp"

namespace farlod {

// The formats of GDAL and netCDF: what makes the writer of a file, and the bytes that the writer holds in memory besides the tile
// that is being written. To make a writer throws OutputError, too.

/// Edge of a block of a GeoTIFF, in pixels: what readers fetch at a time.
inline constexpr std::size_t geotiff_block_edge = 512;
/// GDAL's cache of blocks while the file is copied. Its default, a twentieth of the machine's memory, is more than a copy from
/// one tile to the next has use for.
inline constexpr std::uint64_t geotiff_cache_bytes = 16 << 20;

/// Writes a cloud-optimised GeoTIFF: bands of 32-bit floats with their names, units and definitions, north up, with the raster's
/// CRS and provenance. Pixels without data hold NaN, which the file declares as no data. Blocks are compressed; overviews are
/// averages over the pixels that have data. Until commit(), tiles wait in a file beside the result, four bytes a pixel and band:
/// the layout wants overviews before pixels, and blocks from the north-west on
/// (docs/decisions/0023-cloud-optimised-geotiff.md).
[[nodiscard]] std::unique_ptr<RasterWriter> geotiff_writer(const RasterFrame& frame, const std::filesystem::path& path);
/// What commit() holds: GDAL's cache of blocks, its buffers for overviews, and blocks that are being compressed.
[[nodiscard]] inline std::uint64_t geotiff_bytes(const RasterFrame& frame) {
  // Measured on rasters of 3 to 26 million pixels, for which it is much the same
  constexpr std::uint64_t overview_bytes = 12 << 20;
  // A block as it came, and its compressed bytes, which may be as many; GDAL has one more in turn than it has threads
  const std::uint64_t bytes_of_block = 2 * geotiff_block_edge * geotiff_block_edge * sizeof(float) * frame.bands.size();
  return geotiff_cache_bytes + overview_bytes + (frame.threads == 1 ? 1 : frame.threads + 1) * bytes_of_block;
}

/// Writes a ZIP file of GeoTIFF files, one for each band and called by it: svf.tif, svfN.tif, … With the directional values, and
/// with those of vegetation where there are trees, it is what SOLWEIG asks for, and UMEP calls svfs.zip. Until commit(), the
/// files lie in a folder beside the result.
[[nodiscard]] std::unique_ptr<RasterWriter> zipped_geotiff_writer(const RasterFrame& frame, const std::filesystem::path& path);
inline constexpr std::size_t zip_bytes_at_once = 1 << 20;  ///< when a file comes into the ZIP file
/// What commit() holds: one band after the other is made a GeoTIFF.
[[nodiscard]] inline std::uint64_t zipped_geotiff_bytes(const RasterFrame& frame) {
  RasterFrame one = frame;
  one.bands.resize(1);
  return geotiff_bytes(one) + zip_bytes_at_once;
}

/// Writes a netCDF-4 file after the CF conventions, version 1.8: a variable of 32-bit floats for each band, over `y` (from the
/// north) and `x`, the centres of the pixels; `crs` is the grid mapping. Pixels without data hold NaN, which is the fill value.
/// Tiles are chunks, compressed as they come.
[[nodiscard]] std::unique_ptr<RasterWriter> netcdf_writer(const RasterFrame& frame, const std::filesystem::path& path);
/// The caches of chunks.
[[nodiscard]] inline std::uint64_t netcdf_bytes(const RasterFrame& frame) {
  // A chunk in the cache of each variable; one as it is filtered, and the pixels of a tile that lie inside
  return (frame.bands.size() + 3) * raster_tile_edge * raster_tile_edge * sizeof(float) + NetcdfFile::library_bytes;
}

/// Writes a folder after the Zarr specification, version 2, as xarray reads it (with _ARRAY_DIMENSIONS and consolidated metadata)
/// and as the CF conventions, version 1.8, want it: an array of 32-bit floats for each band, over `y` (from the north) and `x`,
/// the centres of the pixels; `crs` is the grid mapping. Tiles are chunks, compressed as they come; one that does not come is no
/// file.
[[nodiscard]] std::unique_ptr<RasterWriter> zarr_writer(const RasterFrame& frame, const std::filesystem::path& path);
/// A chunk of each array, which GDAL keeps until it gets the next, and that chunk compressed.
[[nodiscard]] inline std::uint64_t zarr_bytes(const RasterFrame& frame) {
  return (2 * frame.bands.size() + 2) * raster_tile_edge * raster_tile_edge * sizeof(float);
}

}  // namespace farlod
