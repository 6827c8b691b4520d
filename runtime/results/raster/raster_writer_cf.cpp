// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_cf.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/expects.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

int add_axis(NetcdfFile& file, int dimension, const char* name, const char* axis) {
  const int variable = file.variable(name, NetcdfType::real, std::array{dimension});
  file.attribute(variable, "standard_name", std::string("projection_") + name + "_coordinate");
  file.attribute(variable, "long_name",
                 axis == std::string("X") ? "easting of the pixel's centre" : "northing of the pixel's centre");
  file.attribute(variable, "units", "m");
  file.attribute(variable, "axis", axis);
  return variable;
}

void add_grid_mapping(NetcdfFile& file, const RasterFrame& raster) {
  const int crs = file.crs(raster.crs_wkt, raster.epsg);
  // GDAL does not find the corner of the first pixel without it
  const double step = raster.step_m;
  file.attribute(crs, "GeoTransform",
                 shortest_decimal(raster.north_west_m.x) + " " + shortest_decimal(step) + " 0 " +
                     shortest_decimal(raster.north_west_m.y) + " 0 " + shortest_decimal(-step));
}

int add_band(NetcdfFile& file, const Band& band, std::array<int, 2> dimensions, const RasterFrame& raster) {
  const int variable = file.variable(band.name, NetcdfType::single_real, dimensions);
  file.compress(variable, std::array{std::min(raster_tile_edge, raster.rows), std::min(raster_tile_edge, raster.columns)});
  file.declare_missing(variable);
  file.attribute(variable, "long_name", band.definition);
  file.attribute(variable, "units", band.unit);
  if (!raster.crs_wkt.empty()) file.attribute(variable, "grid_mapping", "crs");
  return variable;
}

/// Some thousand numbers at a time.
void write_axis(NetcdfFile& file, int variable, std::size_t count, double first, double step) {
  constexpr std::size_t at_once = 4096;
  std::vector<double> centres;
  for (std::size_t begin = 0; begin < count; begin += at_once) {
    centres.clear();
    for (std::size_t n = begin; n < std::min(begin + at_once, count); ++n)
      centres.push_back(first + (static_cast<double>(n) + 0.5) * step);
    file.put(variable, std::array{begin}, std::array{centres.size()}, centres);
  }
}

}  // namespace

struct CfRasterWriter::Impl {
  RasterFrame frame;
  NetcdfFile file;
  std::vector<int> bands;  ///< the variables

  Impl(const RasterFrame& raster, const std::filesystem::path& path) : frame(raster), file(path) {}
};

CfRasterWriter::CfRasterWriter(const RasterFrame& frame, const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(frame, path)) {
  NetcdfFile& file = impl_->file;
  file.describe(frame.bands.front().definition, frame.provenance);
  const int y = file.dimension("y", frame.rows), x = file.dimension("x", frame.columns);
  const int y_axis = add_axis(file, y, "y", "Y"), x_axis = add_axis(file, x, "x", "X");
  if (!frame.crs_wkt.empty()) add_grid_mapping(file, frame);
  for (const Band& band : frame.bands) impl_->bands.push_back(add_band(file, band, {y, x}, frame));
  file.end_definitions();
  write_axis(file, y_axis, frame.rows, frame.north_west_m.y, -frame.step_m);
  write_axis(file, x_axis, frame.columns, frame.north_west_m.x, frame.step_m);
}

CfRasterWriter::~CfRasterWriter() = default;

void CfRasterWriter::write(const RasterTile& tile) {
  const std::vector<std::span<const float>> bands = bands_of(tile);
  FARLOD_EXPECTS(bands.size() == impl_->bands.size());
  const std::array<std::size_t, 2> first{tile.place.row * raster_tile_edge, tile.place.column * raster_tile_edge};
  const std::array<std::size_t, 2> size{pixels_of_tile(tile.place.row, impl_->frame.rows),
                                        pixels_of_tile(tile.place.column, impl_->frame.columns)};
  std::vector<float> inside(size[0] * size[1]);
  for (std::size_t n = 0; n < bands.size(); ++n) {
    for (std::size_t row = 0; row < size[0]; ++row)
      std::copy_n(bands[n].data() + row * raster_tile_edge, size[1], inside.data() + row * size[1]);
    impl_->file.put(impl_->bands[n], first, size, inside);
  }
}

void CfRasterWriter::commit() { impl_->file.commit(); }

}  // namespace farlod
