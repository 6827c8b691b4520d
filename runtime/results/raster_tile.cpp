// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster_tile.hpp"

#include <algorithm>
#include <limits>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t pixels_in_tile = raster_tile_edge * raster_tile_edge;

void copy_tile(const SkyRaster& raster, const std::vector<float>& from, TilePlace place, std::vector<float>& to) {
  const std::size_t columns = pixels_of_tile(place.column, raster.columns);
  for (std::size_t row = 0; row < pixels_of_tile(place.row, raster.rows); ++row) {
    const std::size_t first = (place.row * raster_tile_edge + row) * raster.columns + place.column * raster_tile_edge;
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(first), columns,
                to.begin() + static_cast<std::ptrdiff_t>(row * raster_tile_edge));
  }
}

}  // namespace

RasterTile::RasterTile(TilePlace where, RasterBands bands)
    : place(where), svf(pixels_in_tile, nothing), low(bands == RasterBands::answers ? 0 : pixels_in_tile, nothing), high(low) {}

void for_each_tile(const SkyRaster& raster, const std::function<void(const RasterTile&)>& visit) {
  const bool has_bounds = raster.bands == RasterBands::answers_and_bounds;
  FARLOD_EXPECTS(raster.svf.size() == raster.columns * raster.rows && raster.low.size() == raster.high.size());
  FARLOD_EXPECTS(raster.low.size() == (has_bounds ? raster.svf.size() : 0));
  for (TilePlace place; place.row < tiles_along(raster.rows); ++place.row)
    for (place.column = 0; place.column < tiles_along(raster.columns); ++place.column) {
      RasterTile tile(place, raster.bands);
      copy_tile(raster, raster.svf, place, tile.svf);
      if (has_bounds) copy_tile(raster, raster.low, place, tile.low);
      if (has_bounds) copy_tile(raster, raster.high, place, tile.high);
      visit(tile);
    }
}

}  // namespace farlod
