// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/expects.hpp"
#include "results/raster/raster_writers.hpp"
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

class CfRasterWriter final : public RasterWriter {
 public:
  CfRasterWriter(const RasterFrame& frame, const std::filesystem::path& path) : frame_(frame), file_(path) {
    file_.describe(frame.bands.front().definition, frame.provenance);
    const int y = file_.dimension("y", frame.rows), x = file_.dimension("x", frame.columns);
    const int y_axis = add_axis(file_, y, "y", "Y"), x_axis = add_axis(file_, x, "x", "X");
    if (!frame.crs_wkt.empty()) add_grid_mapping(file_, frame);
    for (const Band& band : frame.bands) bands_.push_back(add_band(file_, band, {y, x}, frame));
    file_.end_definitions();
    write_axis(file_, y_axis, frame.rows, frame.north_west_m.y, -frame.step_m);
    write_axis(file_, x_axis, frame.columns, frame.north_west_m.x, frame.step_m);
  }
  void write(const RasterTile& tile) override {
    const std::vector<std::span<const float>> bands = bands_of(tile);
    FARLOD_EXPECTS(bands.size() == bands_.size());
    const std::array<std::size_t, 2> first{tile.place.row * raster_tile_edge, tile.place.column * raster_tile_edge};
    const std::array<std::size_t, 2> size{pixels_of_tile(tile.place.row, frame_.rows),
                                          pixels_of_tile(tile.place.column, frame_.columns)};
    std::vector<float> inside(size[0] * size[1]);
    for (std::size_t n = 0; n < bands.size(); ++n) {
      for (std::size_t row = 0; row < size[0]; ++row)
        std::copy_n(bands[n].data() + row * raster_tile_edge, size[1], inside.data() + row * size[1]);
      file_.put(bands_[n], first, size, inside);
    }
  }
  void commit() override { file_.commit(); }

 private:
  RasterFrame frame_;
  NetcdfFile file_;
  std::vector<int> bands_;  ///< the variables
};

}  // namespace

std::unique_ptr<RasterWriter> netcdf_writer(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<CfRasterWriter>(frame, path);
}

}  // namespace farlod
