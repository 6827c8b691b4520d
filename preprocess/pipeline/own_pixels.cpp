// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/own_pixels.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "tiles/pixel_steps.hpp"

namespace farlod::pipeline {

std::optional<package::SurfacePixels> own_pixels_of(const ReadCity& city) {
  const auto& raster = city.ground.terrain;
  if (!raster || raster->is_resampled || !city.located.city.buildings().empty() || raster->step_m.x != raster->step_m.y)
    return std::nullopt;
  const double step_m = raster->step_m.x;
  const Point2d middle = raster->node(0, raster->rows - 1) + city.located.georeference.origin_m;
  // Whole micrometres, as in the file: the frame's origin was subtracted, and is added again
  const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6; };
  return package::SurfacePixels{{rounded(middle.x - 0.5 * step_m), rounded(middle.y + 0.5 * step_m)},
                                step_m,
                                static_cast<std::uint32_t>(raster->columns),
                                static_cast<std::uint32_t>(raster->rows)};
}

std::optional<tiles::SquaresOfReaders> squares_of_readers(const StageSettings& settings) {
  if (settings.choice || settings.far_map.kind == FarMapKind::box) return std::nullopt;
  // The far maps of an area are baked from all of the surface
  return settings.area ? tiles::SquaresOfReaders::behind : tiles::SquaresOfReaders::absent;
}

namespace {

/// Nothing where the ground is not rough for certain.
std::optional<std::uint64_t> leave_out_squares(tiles::Ground& ground, const package::SurfacePixels& pixels, const Grid& grid,
                                               tiles::SquaresOfReaders squares) {
  const auto are_enough = [&](std::uint64_t count) { return package::is_rough(pixels, 2 * count); };
  const std::uint64_t count = ground.leave_out_squares(grid, squares, are_enough);
  return count > 0 ? std::optional(count) : std::nullopt;
}

}  // namespace

void write_heights(const std::filesystem::path& folder, const ReadCity& city, tiles::Ground& ground, double height_origin_m,
                   const std::optional<tiles::SquaresOfReaders>& squares, package::SurfacePixels& pixels) {
  const TerrainRaster& raster = *city.ground.terrain;
  if (squares) pixels.squares = leave_out_squares(ground, pixels, city.ground.grid, *squares);
  const auto heights_of = [&](std::size_t row, std::span<float> height_m) {
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const std::optional<float>& height = raster.height_m[row * raster.columns + column];
      height_m[column] = height ? static_cast<float>(*height - height_origin_m) : std::numeric_limits<float>::quiet_NaN();
    }
  };
  PixelHeightRows heights{heights_of, ground.pixel_steps().joined()};
  if (pixels.squares) heights.in_grid = tiles::pixels_in_grid(raster, city.ground.grid.rotation);
  pixels.heights = write_pixel_heights(folder, pixels, heights);
  pixels.walls = ground.pixel_steps().count();
}

}  // namespace farlod::pipeline
