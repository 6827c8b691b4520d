// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "results/raster/raster_writer_gdal.hpp"

namespace farlod {

/// Writes a ZIP file of GeoTIFF files, one for each band and called by it: svf.tif, svfN.tif, … With the directional values, and
/// with those of vegetation where there are trees, it is what SOLWEIG asks for, and UMEP calls svfs.zip. Until commit(), the
/// files lie in a folder beside the result.
class ZippedGeotiffWriter : public RasterWriter {
 public:
  static constexpr std::size_t bytes_at_once = 1 << 20;  ///< when a file comes into the ZIP file
  /// Throws OutputError, as do the other functions.
  ZippedGeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path);
  ~ZippedGeotiffWriter() override;
  void write(const RasterTile& tile) override;
  void commit() override;
  /// What commit() holds: one band after the other is made a GeoTIFF.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame) {
    RasterFrame one = frame;
    one.bands.resize(1);
    return GeotiffWriter::bytes_for(one) + bytes_at_once;
  }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
