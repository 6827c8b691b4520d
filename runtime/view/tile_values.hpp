// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "view/tile_surfaces.hpp"

namespace farlod {

/// Azimuths of the values that colours show: of tiles of one cell or less, and of larger ones, whose facets stand for more than
/// themselves. Of the places that are asked for one by one, it is default_azimuths.
inline constexpr std::size_t azimuths_of_cells = 96, azimuths_of_larger_tiles = 32;

/// How far in front of its surface a receiver stands.
inline constexpr double receiver_offset_m = 0.01;

/// The sky view factor of each facet: of ground 1.5 m above it, looking up; of others on the surface, along its normal. NaN where
/// there is none. A facet of the ground whose middle lies in a building has the mean of what is free of it.
/// Throws PackageUnusable, PackageDamaged.
[[nodiscard]] std::vector<float> values_of(const Package& package, const ViewFrame& frame, const TileSurfaces& surfaces,
                                           std::size_t azimuths);

}  // namespace farlod
