// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "package/tile_set.hpp"
#include "tiles/ground.hpp"

namespace farlod::tiles {

/// A facet farther than this from its plane is reported (the default tolerance of val3dity).
inline constexpr double planarity_tolerance_m = 0.01;

/// Called once, when the ground is known and before it or a building is cut. Heights in the tiles count from `height_origin_m`.
/// Returns how many squares of the ground it leaves to readers (Ground::leave_out_squares).
using OnGround = std::function<std::uint64_t(Ground& ground, double height_origin_m)>;

/// Triangulates the city and its ground and cuts them into the cells of the grid.
///   (1) the tiles partition the city: the exact area vectors of a facet's pieces sum to its own, and no piece lies in two tiles
///   (2) a facet that is not in the tiles is in the report
///   (3) the result does not depend on the number of threads
/// The ground is a network through the nodes of the terrain's raster; without one, through the points of the city's relief;
/// without both, through the buildings' base points. Onto raster or relief those buildings are lifted that know only their height
/// above ground. Throws Cancelled when `stop` is asked for.
[[nodiscard]] TileSet cut_into_tiles(LocatedCity located, const Grid& grid, Assign assign,
                                     const std::optional<TerrainRaster>& terrain, Report& report,
                                     const std::stop_token& stop = {}, const OnGround& on_ground = {});

}  // namespace farlod::tiles
