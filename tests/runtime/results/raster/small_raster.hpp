// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

#include "results/raster/raster_writer.hpp"

namespace farlod {

/// A raster with all of its values. The programs never hold one; tests compare with it.
struct WholeRaster : RasterFrame {
  std::vector<float> svf;        ///< row by row from the north, each from the west; NaN where there is no data
  std::vector<float> low, high;  ///< bounds, or empty
};

[[nodiscard]] inline RasterTile tile_of(const WholeRaster& raster, TilePlace place) {
  RasterTile tile(place, raster.bands.size() > 1 ? RasterBands::svf_and_bounds : RasterBands::svf);
  const auto copy = [&](const std::vector<float>& from, std::vector<float>& to) {
    if (to.empty()) return;
    for (std::size_t row = 0; row < pixels_of_tile(place.row, raster.rows); ++row)
      for (std::size_t column = 0; column < pixels_of_tile(place.column, raster.columns); ++column)
        to[row * raster_tile_edge + column] =
            from.at((place.row * raster_tile_edge + row) * raster.columns + place.column * raster_tile_edge + column);
  };
  copy(raster.svf, tile.svf);
  copy(raster.low, tile.low);
  copy(raster.high, tile.high);
  return tile;
}

/// All tiles, row by row from the north-west.
[[nodiscard]] inline std::vector<RasterTile> tiles_of(const WholeRaster& raster) {
  std::vector<RasterTile> tiles;
  for (std::size_t row = 0; row < tiles_along(raster.rows); ++row)
    for (std::size_t column = 0; column < tiles_along(raster.columns); ++column) tiles.push_back(tile_of(raster, {row, column}));
  return tiles;
}

template <class Writer>
std::unique_ptr<RasterWriter> made(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<Writer>(frame, path);
}

/// Writes the raster by a writer of the programs, which a function makes.
template <auto make_writer>
void write_whole(const WholeRaster& raster, const std::filesystem::path& path) {
  const std::unique_ptr<RasterWriter> writer = make_writer(raster, path);
  for (const RasterTile& tile : tiles_of(raster)) writer->write(tile);
  writer->commit();
}

/// 5 × 3 pixels of 2 m, somewhere in UTM 32N: every value different, two pixels without an answer.
[[nodiscard]] inline WholeRaster small_raster() {
  const float none = std::numeric_limits<float>::quiet_NaN();
  WholeRaster raster;
  raster.north_west_m = {500000.25, 5700010.5};
  raster.step_m = 2.0;
  raster.columns = 5;
  raster.rows = 3;
  raster.svf = {1.0F, none, 0.1F, 0.2F, 0.3F, 0.0F, 0.987654F, 0.4F, 0.5F, 0.6F, 0.7F, 0.8F, none, 0.9F, 0.33333334F};
  raster.bands = svf_bands("svf", RasterBands::svf);
  raster.crs_wkt =
      R"(PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_1989",SPHEROID["GRS 1980",6378137,298.257222101,AUTHORITY["EPSG","7019"]],AUTHORITY["EPSG","6258"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4258"]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG","25832"]])";
  return raster;
}

}  // namespace farlod
