// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_esri_ascii.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <span>
#include <string>

#include "results/atomic_file.hpp"
#include "results/decimal.hpp"

namespace farlod {
namespace {

// The decimal point makes readers take the grid for floats, even where each value is 1
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

}  // namespace

EsriAsciiWriter::EsriAsciiWriter(const RasterFrame& frame, const std::filesystem::path& path)
    : frame_(frame), path_(path), spool_(path) {}

void EsriAsciiWriter::write(const RasterTile& tile) {
  places_.emplace(tile.place, spool_.append(std::as_bytes(std::span(tile.svf))));
}

std::vector<float> EsriAsciiWriter::band(std::size_t tile_row) {
  std::vector<float> band(frame_.columns * pixels_of_tile(tile_row, frame_.rows), std::numeric_limits<float>::quiet_NaN());
  std::vector<float> tile(raster_tile_edge * raster_tile_edge);
  for (auto t = places_.lower_bound({tile_row, 0}); t != places_.end() && t->first.row == tile_row; ++t) {
    spool_.read(t->second, std::as_writable_bytes(std::span(tile)));
    const std::size_t column = t->first.column * raster_tile_edge;
    for (std::size_t row = 0; row < band.size() / frame_.columns; ++row)
      std::copy_n(tile.begin() + static_cast<std::ptrdiff_t>(row * raster_tile_edge),
                  pixels_of_tile(t->first.column, frame_.columns),
                  band.begin() + static_cast<std::ptrdiff_t>(row * frame_.columns + column));
  }
  return band;
}

void EsriAsciiWriter::write_rows(std::ostream& out) {
  for (std::size_t tile_row = 0; tile_row < tiles_along(frame_.rows); ++tile_row) {
    std::size_t pixels = 0;
    for (const float svf : band(tile_row)) {
      write_pixel(out, svf);
      out << (++pixels % frame_.columns == 0 ? '\n' : ' ');
    }
  }
}

void EsriAsciiWriter::commit() {
  write_atomically(path_, [this](std::ostream& out) {
    write_header(out, frame_);
    write_rows(out);
  });
  if (frame_.crs_wkt.empty()) return;
  auto prj = path_;
  write_atomically(prj.replace_extension(".prj"), [this](std::ostream& out) { out << frame_.crs_wkt << '\n'; });
}

}  // namespace farlod
