// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "base/frame.hpp"
#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "tiles/pixel_steps.hpp"
#include "tiles/stepped_surface.hpp"

namespace farlod::tiles {

/// The ground of a surface model: its surface, and the heights of its pixels. Lasts no longer than the raster.
class ModelledGround {
 public:
  ModelledGround(const TerrainRaster& raster, const PixelSteps& steps, const GridRotation& rotation);

  [[nodiscard]] const SteppedSurface& surface() const { return surface_; }
  /// That of the pixel there; where it has none or lies beyond the raster, of the nearest on its row, else the lowest of all.
  [[nodiscard]] double height_at(Point2d p_grid) const;
  [[nodiscard]] std::optional<double> lowest_m() const { return lowest_m_; }

 private:
  const TerrainRaster& raster_;
  GridRotation rotation_;
  SteppedSurface surface_;
  std::optional<double> lowest_m_;
};

}  // namespace farlod::tiles
