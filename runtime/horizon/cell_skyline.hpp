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

/// What receivers of one cell may see of the city, apart from what its far map leaves unnamed: edges by their roles (EdgeRole), cell
/// frame.
struct CellSkyline {
  SkylineEdges grounded, overhangs, undersides;
};

/// The neighbourhood and what the far map names, for receivers in a box: edges that face away from all of them are left out.
[[nodiscard]] CellSkyline cell_skyline(const Package& package, Cell cell, const FarHorizon& far, const ReceiverBox& box);

/// The box around some receivers.
[[nodiscard]] ReceiverBox box_around(std::span<const Receiver> receivers);

}  // namespace farlod
