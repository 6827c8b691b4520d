// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <vector>

#include "results/sky_raster.hpp"

namespace farlod {

/// Edge of a raster's tiles, in pixels: the one that GeoTIFF files have when nobody says otherwise.
inline constexpr std::size_t raster_tile_edge = 256;

/// The place of a tile among the tiles of a raster, from the north-west; they are ordered row by row.
struct TilePlace {
  std::size_t row = 0, column = 0;
  auto operator<=>(const TilePlace&) const = default;
};

/// A square part of a raster. Pixels without an answer, and those of the last tiles that lie beyond the raster, hold NaN.
struct RasterTile {
  TilePlace place;
  std::vector<float> svf;        ///< raster_tile_edge rows from the north, each from the west
  std::vector<float> low, high;  ///< certain bounds, or empty

  RasterTile(TilePlace where, RasterBands bands);
};

/// Tiles that a raster has along an edge of so many pixels.
[[nodiscard]] constexpr std::size_t tiles_along(std::size_t pixels) { return (pixels + raster_tile_edge - 1) / raster_tile_edge; }

/// How many of a tile's columns, or rows, lie in the raster.
[[nodiscard]] constexpr std::size_t pixels_of_tile(std::size_t tile, std::size_t pixels) {
  const std::size_t left = pixels - tile * raster_tile_edge;
  return left < raster_tile_edge ? left : raster_tile_edge;
}

/// Cuts a raster into its tiles, row by row from the north-west.
void for_each_tile(const SkyRaster& raster, const std::function<void(const RasterTile&)>& visit);

}  // namespace farlod
