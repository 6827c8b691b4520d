// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_esri_ascii.hpp"

#include <cmath>
#include <ostream>

#include "results/atomic_file.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

// With the decimal point, readers take the grid for floats even where each value is 1
constexpr const char* nodata = "-9999.0";

void write_header(std::ostream& out, const RasterFrame& raster) {
  const double south = raster.north_west_m.y - static_cast<double>(raster.rows) * raster.step_m;
  out << "ncols " << raster.columns << "\nnrows " << raster.rows << "\nxllcorner " << shortest_decimal(raster.north_west_m.x)
      << "\nyllcorner " << shortest_decimal(south) << "\ncellsize " << shortest_decimal(raster.step_m) << "\nNODATA_value "
      << nodata << '\n';
}

void write_pixel(std::ostream& out, float svf) {
  if (std::isnan(svf))
    out << nodata;
  else
    out << shortest_decimal(svf);
}

/// A raster without a CRS has no .prj file.
void write_prj_beside(std::filesystem::path path, const RasterFrame& raster) {
  if (raster.crs_wkt.empty()) return;
  write_atomically(path.replace_extension(".prj"), [&](std::ostream& out) { out << raster.crs_wkt << '\n'; });
}

}  // namespace

EsriAsciiWriter::EsriAsciiWriter(const RasterFrame& frame, const std::filesystem::path& path)
    : frame_(frame), path_(path), tiles_(frame, path) {}

void EsriAsciiWriter::write_rows(std::ostream& out) {
  for (std::size_t tile_row = 0; tile_row < tiles_along(frame_.rows); ++tile_row) {
    std::size_t pixels = 0;
    for (const float svf : tiles_.pixels_of_tile_row(tile_row)) {
      write_pixel(out, svf);
      out << (++pixels % frame_.columns == 0 ? '\n' : ' ');
    }
  }
}

void EsriAsciiWriter::commit() {
  write_atomically(path_, [this](std::ostream& out) {
    write_header(out, frame_);
    write_rows(out);
    // The grid appears last. A disk that refuses the grid gets no .prj file.
    if (out.flush()) write_prj_beside(path_, frame_);
  });
}

}  // namespace farlod
