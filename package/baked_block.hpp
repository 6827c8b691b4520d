// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>
#include <vector>

#include "farlod/point.hpp"
#include "package/box_map.hpp"
#include "package/horizon_edge.hpp"
#include "package/layout.hpp"
#include "package/receiver_patches.hpp"

namespace farlod {

/// The far map of a cell, of the kind `box`, as captured.
struct BakedBox {
  Point3f capture_cell;  ///< capture point, cell frame
  BoxMap shape;
  /// Texel rows from the horizontal upwards; infinite where the sky is seen; empty when all is sky.
  std::vector<float> distance_m;
};

/// The far map of a cell, of the kind `horizon`: a few explicit occluders, and bounds and an estimate for the residual city,
/// which is all of the far city that is not explicit. Slopes are tangents of elevations, a row of azimuth bins for each patch.
///   (1) from every place in a patch, all of the residual city lies below `high`
///   (2) from every place in a patch, everything below `low` is hidden, unless it lies below `overhang` or below a lower border
///       that is explicit or near
///   (3) `estimate` is the horizon of the residual city, averaged over the patch's floor; between two floors it is interpolated
///   (4) from every place in a patch, no lower border of the residual city (EdgeRole::underside) rises above `overhang`, but
///       those that stand before residual grounded edges that are higher
struct BakedHorizon {
  ReceiverPatches patches;
  std::vector<package::ExplicitOccluder> explicit_edges;
  std::vector<float> low, estimate, high, overhang;
};

/// A block's far maps, in the order of CellRange::index_of.
using BakedBoxes = std::vector<BakedBox>;
struct BakedHorizons {
  std::vector<HorizonEdge> edges;  ///< the explicit ones of its cells, in the frame of its south-west cell
  std::vector<BakedHorizon> cells;
};
using BakedBlock = std::variant<BakedBoxes, BakedHorizons>;

}  // namespace farlod
