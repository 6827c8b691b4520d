// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "farlod/far_map/far_horizon.hpp"
#include "farlod/grid.hpp"
#include "horizon/skyline_edges.hpp"
#include "package/package.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Borders of what may be seen under: EdgeRole::overhang and EdgeRole::underside.
struct OverhangEdges {
  SkylineEdges upper{EdgeRole::overhang}, lower{EdgeRole::underside};
  [[nodiscard]] bool empty() const { return upper.empty() && lower.empty(); }
};

/// What receivers of one cell may see of the city, apart from what its far map leaves unnamed. Cell frame.
struct CellSkyline {
  SkylineEdges grounded;  ///< near and far
  OverhangEdges near, far;
};

/// The neighbourhood and what the far map names, for receivers in a box: edges that face away from all of them are left out.
[[nodiscard]] CellSkyline cell_skyline(const Package& package, Cell cell, const FarHorizon& far, const ReceiverBox& box);

/// The box around some receivers.
[[nodiscard]] ReceiverBox box_around(std::span<const Receiver> receivers);

}  // namespace farlod
