// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "farlod/far_map/far_horizon.hpp"
#include "farlod/grid.hpp"
#include "farlod/point.hpp"
#include "horizon/skyline_edges.hpp"
#include "package/package.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// What receivers of one cell may see of the city, apart from what its far map leaves unnamed. Cell frame. What stands solidly
/// (SurfaceRecord::stands) is there by its edges, all else by its triangles, since it may be seen under.
struct CellSkyline {
  SkylineEdges standing;
  std::vector<std::array<Point3f, 3>> hanging;
};

/// The neighbourhood and what the far map names, for receivers in a box: edges that face away from all of them are left out.
[[nodiscard]] CellSkyline cell_skyline(const Package& package, Cell cell, const FarHorizon& far, const ReceiverBox& box);

/// The box around some receivers.
[[nodiscard]] ReceiverBox box_around(std::span<const Receiver> receivers);

}  // namespace farlod
