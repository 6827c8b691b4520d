// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
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
  ModelledGround(const TerrainRaster& raster, PixelSteps steps, const GridRotation& rotation);

  /// Before the surface is asked for: PixelSteps::leave_out_squares.
  std::uint64_t leave_out_squares(const Grid& grid, SquaresOfReaders squares,
                                  const std::function<bool(std::uint64_t)>& are_enough);
  [[nodiscard]] const PixelSteps& steps() const { return steps_; }
  /// Made when it is first asked for, by one thread.
  [[nodiscard]] const SteppedSurface& surface() const;
  /// That of the pixel there; where it has none or lies beyond the raster, of the nearest on its row, else the lowest of all.
  [[nodiscard]] double height_at(Point2d p_grid) const;
  [[nodiscard]] std::optional<double> lowest_m() const { return lowest_m_; }

 private:
  const TerrainRaster& raster_;
  PixelSteps steps_;
  GridRotation rotation_;
  SquaresOfReaders squares_ = SquaresOfReaders::behind;
  mutable std::optional<SteppedSurface> surface_;
  std::optional<double> lowest_m_;
};

}  // namespace farlod::tiles
