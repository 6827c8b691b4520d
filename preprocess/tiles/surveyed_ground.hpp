// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "base/grid.hpp"
#include "city/terrain_raster.hpp"
#include "tiles/ground.hpp"

namespace farlod::tiles {

/// The ground through the nodes of a raster, or through the points of a relief; nothing when there is neither.
[[nodiscard]] std::optional<Ground> surveyed_ground(const std::optional<TerrainRaster>& terrain,
                                                    std::span<const Point3d> relief_points_city, const Grid& grid,
                                                    GroundExtent extent);

}  // namespace farlod::tiles
