// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "farlod/grid.hpp"
#include "horizon/silhouette_edges.hpp"
#include "package/far_horizon.hpp"
#include "package/package.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Borders of what may be seen under: EdgeRole::overhang and EdgeRole::underside.
struct OverhangEdges {
  SilhouetteEdges overhangs{EdgeRole::overhang}, undersides{EdgeRole::underside};
  [[nodiscard]] bool empty() const { return overhangs.empty() && undersides.empty(); }
};

/// What receivers of one cell may see of the city, apart from what its far map leaves to the residual horizon. Cell frame.
struct CellSilhouettes {
  SilhouetteEdges grounded;  ///< near and far
  OverhangEdges near, far;
};

/// The neighborhood and what the far map names, for receivers in a box: edges that face away from all of them are left out.
[[nodiscard]] CellSilhouettes cell_silhouettes(const Package& package, Cell cell, const FarHorizon& far, const ReceiverBox& box);

/// The box around some receivers.
[[nodiscard]] ReceiverBox bounding_box(std::span<const Receiver> receivers);

}  // namespace farlod
