// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/export.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// A north-up raster in the package's CRS, whose pixel centres are the receivers. Row 0 is the northernmost.
struct RasterPlan {
  Point2d north_west_m;  ///< outer corner of the first pixel
  double step_m = 1.0;   ///< edge of a pixel
  std::size_t columns = 0, rows = 0;

  [[nodiscard]] Point2d centre_m(std::size_t column, std::size_t row) const {
    return {north_west_m.x + (static_cast<double>(column) + 0.5) * step_m,
            north_west_m.y - (static_cast<double>(row) + 0.5) * step_m};
  }
};

/// The raster over `part` (projected), or over the city (PackageDescription::city_projected). Pixels begin at multiples of the
/// step (0.01 to 10,000 m), so that rasters of neighboring runs fit together. Throws InvalidArgument.
[[nodiscard]] FARLOD_EXPORT RasterPlan plan_raster(const Package& package, double step_m, const std::optional<Box2d>& part = {});

/// The pixels of the raster that the city is, if it is one (PackSettings::inputs), as they were packed; those that meet `part`
/// (projected), of which there must be some. Throws InvalidArgument.
[[nodiscard]] FARLOD_EXPORT std::optional<RasterPlan> plan_of_surface_model(const Package& package,
                                                                            const std::optional<Box2d>& part = {});

/// Edge of a raster's tiles, in pixels: GDAL's default for tiled GeoTIFF files.
inline constexpr std::size_t raster_tile_edge = 256;

/// Row and column of a tile among the tiles of a raster, counted from the north-west. Tiles are ordered row by row.
struct TilePlace {
  std::size_t row = 0, column = 0;
  auto operator<=>(const TilePlace&) const = default;
};

/// Number of tiles along an edge of `pixels` pixels.
[[nodiscard]] constexpr std::size_t tiles_along(std::size_t pixels) { return (pixels + raster_tile_edge - 1) / raster_tile_edge; }

/// Number of columns (or rows) of a tile that lie within the raster; 0 of a tile beyond it.
[[nodiscard]] constexpr std::size_t pixels_of_tile(std::size_t tile, std::size_t pixels) {
  if (tile >= tiles_along(pixels)) return 0;
  const std::size_t left = pixels - tile * raster_tile_edge;
  return left < raster_tile_edge ? left : raster_tile_edge;
}

/// The bands of a raster: the sky view factor, or the sky view factor, its lower and its upper bound.
enum class RasterBands { svf, svf_and_bounds };

/// A square part of a raster. Pixels without data hold NaN, and so do the pixels of the last tiles beyond the raster's edge.
struct RasterTile {
  TilePlace place;
  std::vector<float> svf;        ///< raster_tile_edge rows from the north, each from the west
  std::vector<float> low, high;  ///< bounds, or empty
  /// A band for each of columns_of(EvaluationSettings::further).
  std::vector<std::vector<float>> further;

  FARLOD_EXPORT RasterTile(TilePlace where, RasterBands bands, std::size_t further_bands = 0);
};

/// Takes the tiles as they are done: one at a time, in the same order whatever the number of threads, each once; not at all where
/// no pixel has an answer. The tile is valid during the call only. What it throws ends the run.
using OnRasterTile = std::function<void(const RasterTile&)>;

/// A whole raster, row by row from the north. NaN where there is no data.
struct Raster {
  RasterPlan plan;
  std::vector<float> svf, low, high;        ///< `low` and `high` are empty without EvaluationSettings::bounds
  std::vector<std::vector<float>> further;  ///< a band for each of columns_of(EvaluationSettings::further)
  EvaluationSummary summary;
};

/// Evaluates the sky view factors of a raster's pixels: tile by tile, for rasters of any size, or as a whole. Throws
/// InvalidArgument, Cancelled, LimitReached, PackageUnusable, PackageDamaged.
FARLOD_EXPORT EvaluationSummary evaluate_raster(const Package& package, const RasterPlan& plan, const Placing& placing,
                                                const EvaluationSettings& settings, const OnRasterTile& on_tile,
                                                const RunSettings& run = {});
[[nodiscard]] FARLOD_EXPORT Raster evaluate_raster(const Package& package, const RasterPlan& plan, const Placing& placing = {},
                                                   const EvaluationSettings& settings = {}, const RunSettings& run = {});

/// A rectangle of pixels of a raster, counted from its north-west.
struct RasterWindow {
  std::size_t column = 0, row = 0, columns = 0, rows = 0;
};

/// A part of a raster, for those who divide one among processes: the pixels of the window have the values, to the bit, that
/// evaluate_raster gives them in the whole raster. The receivers of a cell are evaluated together, so that all of a cell is
/// evaluated that the window cuts: windows should be much larger than cells. The plan of the answer is the window's. Of its
/// summary, receivers and no_data (pixels beyond the grid are among them) and the values are the window's, the rest is of all
/// that was evaluated. Throws what evaluate_raster throws, InvalidArgument for a window that is empty or reaches beyond the plan,
/// too.
[[nodiscard]] FARLOD_EXPORT Raster evaluate_window(const Package& package, const RasterPlan& plan, const RasterWindow& window,
                                                   const Placing& placing = {}, const EvaluationSettings& settings = {},
                                                   const RunSettings& run = {});

}  // namespace farlod
