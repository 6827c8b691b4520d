// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/ground_load.hpp"

#include <algorithm>
#include <cstdint>

#include "package/pixel_heights.hpp"
#include "tiles/pixel_square.hpp"
#include "tiles/pixel_steps.hpp"

namespace farlod::pipeline {
namespace {

constexpr std::size_t most_bands = 32, rows_of_band = 9;

/// Triangles of a square that is torn and slopes, with its walls; and of one whose pixels are level, which are parts of
/// rectangles, as are the walls between them. Measured on a generated town on level ground and on relief.
constexpr double triangles_of_torn_square = 7.0, triangles_of_level_square = 0.03;

bool slopes(const tiles::PixelSquare& square) {
  for (std::size_t k = 0; k < 4; ++k)
    if (square.has_height[k] && !square.is_level[k]) return true;
  return false;
}

/// Squares between four pixels by what they are.
struct SampledSquares {
  std::uint64_t whole = 0, torn = 0, level = 0;
  [[nodiscard]] double all() const { return static_cast<double>(whole + torn + level); }

  void add(const TerrainRaster& band) {
    const tiles::PixelSteps steps(band);
    for (std::size_t row = 1; row < band.rows; ++row)
      for (std::size_t column = 1; column < band.columns; ++column) {
        const tiles::PixelSquare square(band, steps, column, row);
        ++(slopes(square) ? square.is_whole() ? whole : torn : level);
      }
  }
};

TerrainRaster band_of(const TerrainRaster& terrain, std::size_t first_row) {
  TerrainRaster band;
  band.step_m = terrain.step_m;
  band.columns = terrain.columns;
  band.rows = std::min(rows_of_band, terrain.rows - first_row);
  const auto* const begin = terrain.height_m.data() + first_row * terrain.columns;
  band.height_m.assign(begin, begin + band.rows * terrain.columns);
  return band;
}

SampledSquares sample(const TerrainRaster& terrain) {
  SampledSquares squares;
  const std::size_t apart = std::max(rows_of_band - 1, terrain.rows / most_bands);
  for (std::size_t row = 0; row + 1 < terrain.rows; row += apart) squares.add(band_of(terrain, row));
  return squares;
}

}  // namespace

GroundLoad ground_load_of(const TerrainRaster& terrain, const Grid& grid, bool may_be_left) {
  GroundLoad load{terrain.height_m.size(), terrain.covers_pixels};
  if (!load.is_surface) return load;
  const SampledSquares squares = sample(terrain);
  const double of_sample = static_cast<double>(load.points) / std::max(squares.all(), 1.0);
  const double whole = static_cast<double>(squares.whole) * of_sample;
  const package::SurfacePixels pixels{
      {}, terrain.step_m.x, static_cast<std::uint32_t>(terrain.columns), static_cast<std::uint32_t>(terrain.rows)};
  load.is_rough = may_be_left && package::is_rough(pixels, static_cast<std::uint64_t>(2.0 * whole));
  // Squares over a border of cells stay, and are cut
  const double at_borders = std::min(1.0, 2.0 * (terrain.step_m.x + terrain.step_m.y) / grid.cell_edge_m);
  load.triangles = 2.0 * whole * (load.is_rough ? at_borders : 1.0 + at_borders) +
                   of_sample * (triangles_of_torn_square * static_cast<double>(squares.torn) +
                                triangles_of_level_square * static_cast<double>(squares.level));
  return load;
}

}  // namespace farlod::pipeline
