// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "base/grid.hpp"
#include "city/city_model.hpp"

namespace farlod::pipeline {

/// What a ground is to the stages that cut and store it, before it is cut.
struct GroundLoad {
  std::size_t points = 0;  ///< nodes of a terrain, points of a relief, or pixels; 0 without ground
  /// A surface model (TerrainRaster::covers_pixels): pixels, no network.
  bool is_surface = false;
  double triangles = 0.0;  ///< of a surface model: that are cut and stored, about
  bool is_rough = false;   ///< a surface model that needs no far maps, most of which is left to readers

  /// The points of a relief, or none.
  [[nodiscard]] static GroundLoad of_points(std::size_t points) { return {points}; }
};

/// The load of a terrain, or of the surface model that it is, judged by a sample of its rows. `may_be_left` to readers, as far as
/// it is rough: squares_of_readers.
[[nodiscard]] GroundLoad ground_load_of(const TerrainRaster& terrain, const Grid& grid, bool may_be_left);

}  // namespace farlod::pipeline
