// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "results/raster/raster_frame.hpp"

namespace farlod {

/// Edge of a raster's tiles, in pixels: GDAL's default for tiled GeoTIFF files.
inline constexpr std::size_t raster_tile_edge = 256;

/// Row and column of a tile among the tiles of a raster, counted from the north-west. Tiles are ordered row by row.
struct TilePlace {
  std::size_t row = 0, column = 0;
  auto operator<=>(const TilePlace&) const = default;
};

/// A square part of a raster. Pixels without data hold NaN, and so do the pixels of the last tiles beyond the raster's edge.
struct RasterTile {
  TilePlace place;
  std::vector<float> svf;        ///< raster_tile_edge rows from the north, each from the west
  std::vector<float> low, high;  ///< bounds, or empty

  RasterTile(TilePlace where, RasterBands bands);
};

/// Number of tiles along an edge of `pixels` pixels.
[[nodiscard]] constexpr std::size_t tiles_along(std::size_t pixels) { return (pixels + raster_tile_edge - 1) / raster_tile_edge; }

/// Number of columns (or rows) of a tile that lie within the raster.
[[nodiscard]] constexpr std::size_t pixels_of_tile(std::size_t tile, std::size_t pixels) {
  const std::size_t left = pixels - tile * raster_tile_edge;
  return left < raster_tile_edge ? left : raster_tile_edge;
}

}  // namespace farlod
