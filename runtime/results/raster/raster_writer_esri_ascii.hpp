// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "results/raster/raster_writer.hpp"
#include "results/spool_file.hpp"

namespace farlod {

/// Writes an ESRI ASCII grid, and its CRS to a .prj file beside it (no file when the raster has no CRS). The WKT is written
/// unchanged; most readers of .prj files read WKT 1 only (see esri_wkt_of). Pixels without data hold -9999, which the header
/// declares. The format has one band, hence no bounds. Tiles are kept in a spool file, four bytes a pixel, until commit(),
/// because a line of the file crosses all tiles of a row.
class EsriAsciiWriter : public RasterWriter {
 public:
  EsriAsciiWriter(const RasterFrame& frame, const std::filesystem::path& path);
  void write(const RasterTile& tile) override;
  void commit() override;
  /// A row of tiles, which commit() reads back.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame) {
    return frame.columns * raster_tile_edge * sizeof(float);
  }

 private:
  /// The pixels of a row of tiles, row by row.
  [[nodiscard]] std::vector<float> band(std::size_t tile_row);
  void write_rows(std::ostream& out);

  RasterFrame frame_;
  std::filesystem::path path_;
  SpoolFile spool_;
  std::map<TilePlace, std::uint64_t> places_;  ///< of tiles in the spool file
};

}  // namespace farlod
