// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster_writer_esri_ascii.hpp"

#include <cmath>
#include <ostream>
#include <string>

#include "farlod/expects.hpp"
#include "results/atomic_file.hpp"
#include "results/decimal.hpp"

namespace farlod {
namespace {

// The point tells readers that the grid holds fractions, even where all the sky is free and each value is 1
constexpr const char* nodata = "-9999.0";

void write_header(std::ostream& out, const SkyRaster& raster) {
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

}  // namespace

void write_esri_ascii(const SkyRaster& raster, const std::filesystem::path& path) {
  FARLOD_EXPECTS(raster.svf.size() == raster.columns * raster.rows);
  write_text_atomically(path, [&raster](std::ostream& out) {
    write_header(out, raster);
    for (std::size_t n = 0; n < raster.svf.size(); ++n) {
      write_pixel(out, raster.svf[n]);
      out << ((n + 1) % raster.columns == 0 ? '\n' : ' ');
    }
  });
  if (raster.crs_wkt.empty()) return;
  auto prj = path;
  write_text_atomically(prj.replace_extension(".prj"), [&raster](std::ostream& out) { out << raster.crs_wkt << '\n'; });
}

}  // namespace farlod
