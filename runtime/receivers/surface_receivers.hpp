// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "farlod/surfaces.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Distance of a receiver from its surface, so that the surface itself does not block it: a hundred times the rounding of a
/// coordinate in a scene of 10 km (0.5 mm would do), and a fiftieth of a window's reveal.
inline constexpr float surface_offset_m = 0.01F;

/// A receiver on a surface, and the area that it stands for.
struct SurfaceReceiver {
  std::uint32_t triangle = 0;  ///< of the cell's tile
  float area_m2 = 0.0F;
  Point3f p_cell;                   ///< off the surface by surface_offset_m, or ahead of its top by as much
  Point3f normal;                   ///< the surface's, grid frame
  bool is_inside_building = false;  ///< or below the ground: a party wall, a cellar
};

/// Spreads receivers over the pieces of surfaces in one tile: each triangle of area A has ⌈A/spacing²⌉ of them, at least one,
/// evenly placed (the R2 sequence, folded into the triangle), each standing for an equal share of its area. Areas therefore add
/// up to the surface's own, whatever the spacing. Throws Cancelled when `stop` is asked for.
[[nodiscard]] std::vector<SurfaceReceiver> surface_receivers(const PackageReader& package, Cell cell, SurfaceChoice choice,
                                                             double spacing_m, const std::stop_token& stop = {});

}  // namespace farlod
