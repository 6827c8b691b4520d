// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/run_settings.hpp"
#include "farlod/raster.hpp"

namespace farlod {

/// Throws InvalidArgument where nothing can be looked up at the pixels of a raster.
inline void require_usable_view(const RasterPlan& plan) {
  constexpr double most_pixels = 1e9;
  require_between("step_m", plan.step_m, 0.01, 10'000.0);
  require_coordinate("north_west_m.x", plan.north_west_m.x);
  require_coordinate("north_west_m.y", plan.north_west_m.y);
  if (plan.columns == 0 || plan.rows == 0) throw InvalidArgument("the raster has no pixels: give a column and a row at least");
  if (static_cast<double>(plan.columns) * static_cast<double>(plan.rows) > most_pixels)
    throw InvalidArgument("the raster has too many pixels: choose a smaller part, or a larger step");
}

}  // namespace farlod
