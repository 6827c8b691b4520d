// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/own_pixels.hpp"

#include <cmath>

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

}  // namespace farlod::pipeline
