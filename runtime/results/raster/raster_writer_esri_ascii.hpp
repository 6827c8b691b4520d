// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>

#include "results/raster/raster_writer.hpp"
#include "results/spool_file.hpp"

namespace farlod {

/// Writes an ESRI ASCII grid, and its CRS to a .prj file beside it (no file when the raster has no CRS). The WKT is written
/// unchanged; most readers of .prj files read WKT 1 only (see esri_wkt_of). Pixels without data hold -9999.0, which the header
/// declares. The format has one band, hence no bounds. Tiles are kept until commit(), because a line of the file crosses all
/// tiles of a row.
class EsriAsciiWriter : public RasterWriter {
 public:
  EsriAsciiWriter(const RasterFrame& frame, const std::filesystem::path& path);
  void write(const RasterTile& tile) override { tiles_.add(tile); }
  void commit() override;
  /// A row of tiles, which commit() reads back.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame) { return TileSpool::bytes_for(frame); }

 private:
  void write_rows(std::ostream& out);

  RasterFrame frame_;
  std::filesystem::path path_;
  TileSpool tiles_;
};

}  // namespace farlod
