// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "results/raster_writer.hpp"
#include "results/spool_file.hpp"

namespace farlod {

/// Writes an ESRI ASCII grid, and its CRS to a .prj file beside it (none when the raster has no CRS). The WKT is written as it
/// is; most readers of .prj files know WKT 1 only (see esri_wkt_of).
/// The format knows numbers only: pixels without an answer hold -9999, which the header declares. It has one band: bounds are
/// left out. Its rows run through all tiles of a row: until the end, tiles wait in a file beside it, four bytes a pixel.
class EsriAsciiWriter : public RasterWriter {
 public:
  EsriAsciiWriter(const RasterFrame& frame, const std::filesystem::path& path);
  void write(const RasterTile& tile) override;
  void commit() override;

 private:
  /// A row of tiles, as pixels row by row.
  [[nodiscard]] std::vector<float> band(std::size_t tile_row);
  void write_rows(std::ostream& out);

  RasterFrame frame_;
  std::filesystem::path path_;
  SpoolFile waiting_;
  std::map<TilePlace, std::uint64_t> waiting_tiles_;  ///< where they wait
};

/// The same for a raster as a whole.
void write_esri_ascii(const SkyRaster& raster, const std::filesystem::path& path);

}  // namespace farlod
