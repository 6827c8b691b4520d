// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_tile.hpp"

#include <limits>

namespace farlod {
namespace {

constexpr float no_data = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t pixels_in_tile = raster_tile_edge * raster_tile_edge;

}  // namespace

RasterTile::RasterTile(TilePlace where, RasterBands bands)
    : place(where), svf(pixels_in_tile, no_data), low(bands == RasterBands::svf ? 0 : pixels_in_tile, no_data), high(low) {}

}  // namespace farlod
