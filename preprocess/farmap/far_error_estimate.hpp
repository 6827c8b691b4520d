// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "farlod/grid.hpp"
#include "farmap/far_map_settings.hpp"
#include "tiles/tile_set.hpp"

namespace farlod {

/// Where far maps are tried out: random receivers of random cells, half of them on the ground, half on whatever is highest there.
struct FarErrorSettings {
  std::size_t cells = 24;
  std::size_t receivers_per_cell = 16;
  std::size_t rays = 1000;
  std::uint64_t seed = 20120901;
  double eye_height_m = 1.5;  ///< above the ground; on roofs receivers stand on the roof itself
};

/// What far maps do to the sky view factor of those receivers. Against `exact` with the same rays, hence without the sampling's
/// share.
struct FarErrorEstimate {
  std::size_t receivers = 0;
  double mean_error = 0.0, max_error = 0.0;  ///< |estimate − exact|
  double p99_doubt = 0.0;                    ///< 99 % of the receivers know their answer for certain to this
  double explicit_per_cell = 0.0;               ///< edges and triangles
  double near_triangles_per_cell = 0.0;      ///< in the neighborhood
};

/// Bakes far maps of the kind `horizon` for a few cells and measures them. The same for the same arguments, on every machine and
/// for any number of threads.
[[nodiscard]] FarErrorEstimate estimate_far_error(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings,
                                           const FarErrorSettings& how);

}  // namespace farlod
