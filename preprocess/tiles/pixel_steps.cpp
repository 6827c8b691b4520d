// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/pixel_steps.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace farlod::tiles
