// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/far_map/receiver_patches.hpp"
#include "farlod/horizon/azimuth.hpp"
#include "farlod/horizon/horizon_edge.hpp"
#include "farlod/package/layout.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The obstacles that a cell's far map names, still in the mapped file.
struct NamedObstacles {
  std::span<const HorizonEdge> edges;               ///< of the whole block, block frame
  std::span<const package::FarTriangle> triangles;  ///< likewise
  std::span<const package::NamedObstacle> named_edges, named_triangles;
  Point2d cell_from_block_m;  ///< added to a place of the block frame, gives the cell frame
};

/// The far map of a cell, of the kind `horizon`: what the city beyond the neighbourhood hides. Slopes are tangents of elevations,
/// for each patch a row of azimuth bins (grid frame).
///   (1) from every place in a patch, all of the far city that is not named lies below `upper`
///   (2) from every place in a patch, everything below `lower` is hidden
///   (3) `likely` is what is seen of the unnamed on average on the patch's floor; between two floors it changes evenly with the height
struct FarHorizon {
  ReceiverPatches patches;
  AzimuthBins bins;
  std::vector<float> lower, likely, upper;
  NamedObstacles named;
};

}  // namespace farlod
