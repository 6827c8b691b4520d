// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/pixel_steps.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tiles/pixel_square.hpp"

namespace farlod::tiles {
namespace {

/// Whether `rise_m` is a step, between what comes before and after it on the same line; NaN where there is nothing.
bool is_step(double before_m, double rise_m, double after_m, double pixel_m) {
  const double high_m = std::abs(rise_m);
  if (!(high_m > step_rule.least_m && high_m > step_rule.least_slope * pixel_m)) return false;
  double continued_m = 0.0;
  for (const double beside_m : {before_m, after_m})
    if (beside_m * rise_m > 0.0) continued_m = std::max(continued_m, std::abs(beside_m));
  return high_m > step_rule.contrast * continued_m;
}

}  // namespace

/// A row or a column of a raster.
struct PixelSteps::Line {
  std::size_t first, stride, count;
  std::uint8_t side;  ///< at which its pixels join the next ones
  double pixel_m;
};

PixelSteps::PixelSteps(const TerrainRaster& raster) : columns_(raster.columns), joined_(raster.height_m.size(), 0) {
  for (std::size_t row = 0; row < raster.rows; ++row) join(raster, {row * columns_, 1, columns_, east, raster.step_m.x});
  for (std::size_t column = 0; column < columns_; ++column) join(raster, {column, columns_, raster.rows, north, raster.step_m.y});
}

void PixelSteps::join(const TerrainRaster& raster, const Line& line) {
  const auto rise_m = [&](std::size_t n) -> double {
    if (n + 1 >= line.count) return std::nan("");
    const auto &from = raster.height_m[line.first + n * line.stride], &to = raster.height_m[line.first + (n + 1) * line.stride];
    return from && to ? double{*to} - double{*from} : std::nan("");
  };
  double before_m = std::nan(""), here_m = rise_m(0);
  for (std::size_t n = 0; n + 1 < line.count; ++n) {
    const double after_m = rise_m(n + 1);
    if (!std::isnan(here_m)) {
      if (is_step(before_m, here_m, after_m, line.pixel_m))
        ++count_;
      else
        joined_[line.first + n * line.stride] |= line.side;
    }
    before_m = here_m;
    here_m = after_m;
  }
}

std::vector<double> PixelSteps::heights_m(const TerrainRaster& raster) const {
  std::vector<double> heights;
  heights.reserve(count_);
  const auto add = [&](std::size_t n, std::size_t next, std::uint8_t side) {
    const auto &from = raster.height_m[n], &to = raster.height_m[next];
    if (from && to && (joined_[n] & side) == 0) heights.push_back(std::abs(double{*to} - double{*from}));
  };
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < columns_; ++column) {
      const std::size_t n = at(column, row);
      if (column + 1 < columns_) add(n, n + 1, east);
      if (row + 1 < raster.rows) add(n, n + columns_, north);
    }
  return heights;
}

PixelsInGrid pixels_in_grid(const TerrainRaster& raster, const GridRotation& rotation) {
  // What the rotation makes of a vector along the x axis: its cosine and its sine, to the bit
  const Point2d turned = rotation.grid_from_city(Point2d{1.0, 0.0});
  return {raster.first.x, raster.first.y, raster.step_m.x, turned.x, turned.y};
}

std::uint64_t PixelSteps::leave_out_squares(const TerrainRaster& raster, const Grid& grid,
                                            const std::function<bool(std::uint64_t)>& are_enough) {
  const PixelsInGrid in_grid = pixels_in_grid(raster, grid.rotation);
  const auto cells_of_row = [&](std::size_t row) {
    std::vector<std::optional<Cell>> cells(columns_);
    for (std::size_t column = 0; column < columns_; ++column) cells[column] = in_grid.cell_around(column, row, grid);
    return cells;
  };
  // Beside what is joined, which other rows ask for meanwhile
  std::vector<std::uint8_t> squares(joined_.size(), 0);
  oneapi::tbb::parallel_for(std::size_t{1}, raster.rows, [&](std::size_t north_row) {
    const std::size_t row = north_row - 1;
    const std::vector<std::optional<Cell>> south = cells_of_row(row), north_cells = cells_of_row(north_row);
    for (std::size_t column = 0; column + 1 < columns_; ++column) {
      const std::optional<Cell>& cell = south[column];
      if (!cell || south[column + 1] != cell || north_cells[column] != cell || north_cells[column + 1] != cell) continue;
      const PixelSquare square(raster, *this, column + 1, north_row);
      if (!square.is_whole() || square.is_level[0]) continue;
      squares[at(column, row)] = square.fold() == 0 ? PixelSquares::left_out : PixelSquares::left_out | PixelSquares::folds_aside;
    }
  });
  const auto count = static_cast<std::uint64_t>(squares.size() - static_cast<std::size_t>(std::ranges::count(squares, 0)));
  if (!are_enough(count)) return 0;
  for (std::size_t n = 0; n < squares.size(); ++n) joined_[n] |= squares[n];
  return count;
}

}  // namespace farlod::tiles
