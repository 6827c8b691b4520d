// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/azimuth.hpp"
#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"
#include "package/layout.hpp"
#include "package/receiver_patches.hpp"

namespace farlod {

/// The explicit occluders of a cell's far map. Views of what somebody else owns: the mapped file.
struct ExplicitOccluders {
  std::span<const HorizonEdge> edges;  ///< of the whole block, block frame
  std::span<const package::ExplicitOccluder> explicit_edges;
  Point2d cell_from_block_m;  ///< added to a place of the block frame, gives the cell frame
};

/// The far map of a cell, of the kind `horizon`: what the city beyond the neighborhood hides. The residual city is all of the far
/// city that is not explicit. Slopes are tangents of elevations, for each patch a row of azimuth bins (grid frame).
///   (1) from every place in a patch, all of the residual city lies below `high`
///   (2) from every place in a patch, everything below `low` is hidden, unless it lies below `overhang` or below a lower border
///       that is explicit or near
///   (3) `estimate` is the horizon of the residual city, averaged over the patch's floor; between two floors it is interpolated
///   (4) from every place in a patch, no lower border of the residual city (EdgeRole::underside) rises above `overhang`, but
///   those
///       that stand before residual grounded edges that are higher
struct FarHorizon {
  ReceiverPatches patches;
  AzimuthBins bins;
  std::vector<float> low, estimate, high, overhang;
  ExplicitOccluders occluders;

  /// The bins of a patch, in `low`, `estimate`, `high` or `overhang`.
  [[nodiscard]] std::span<const float> row(const std::vector<float>& slopes, std::uint32_t patch) const {
    return std::span(slopes).subspan(static_cast<std::size_t>(patch) * bins.count, bins.count);
  }
  /// The layers, as bits, whose explicit occluders count for receivers between two heights: the layers that hold those heights,
  /// and the next one above. That one counts too because `estimate` is interpolated towards its floor, and leaves out what is
  /// explicit there.
  [[nodiscard]] std::uint32_t layers_met_from(float z_low_m, float z_high_m) const {
    const std::uint32_t lowest = patches.layer_of(z_low_m), highest = patches.layer_of(z_high_m) + 1;
    return (std::uint32_t{2} << highest) - (std::uint32_t{1} << lowest);
  }
  /// For the interpolation of `estimate`: the patch above, and the fraction of the way from the floor of `patch` to the floor of
  /// that one at which a height lies, from 0 to 1. The uppermost patch is its own.
  [[nodiscard]] std::pair<std::uint32_t, float> floor_above(std::uint32_t patch, float z_m) const {
    const std::vector<float>& levels_m = patches.levels_m();
    const std::uint32_t layer = patch / patches.squares();
    if (layer + 1 >= levels_m.size()) return {patch, 0.0F};
    const float thickness_m = levels_m[layer + 1] - levels_m[layer];
    return {patch + patches.squares(), thickness_m > 0.0F ? std::max(0.0F, z_m - levels_m[layer]) / thickness_m : 0.0F};
  }
};

}  // namespace farlod
