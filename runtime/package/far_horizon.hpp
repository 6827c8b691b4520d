// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "farlod/far_map/receiver_patches.hpp"
#include "farlod/horizon/azimuth.hpp"
#include "farlod/horizon/horizon_edge.hpp"
#include "farlod/package/layout.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The occluders that a cell's far map names, still in the mapped file.
struct ExplicitOccluders {
  std::span<const HorizonEdge> edges;  ///< of the whole block, block frame
  std::span<const package::ExplicitOccluder> explicit_edges;
  Point2d cell_from_block_m;  ///< added to a place of the block frame, gives the cell frame
};

/// The far map of a cell, of the kind `horizon`: what the city beyond the neighborhood hides. Slopes are tangents of elevations,
/// for each patch a row of azimuth bins (grid frame).
///   (1) from every place in a patch, all of the far city of the residual city lies below `high`
///   (2) from every place in a patch, everything below `low` is hidden, unless it lies below `overhang` or below a lower border
///   that is explicit or near
///   (3) `estimate` is what is seen of the residual city on average on the patch's floor; between two floors it changes evenly with the
///   height
///   (4) from every place in a patch, no lower border of the residual city (EdgeRole::underside) rises above `overhang`, but those that
///   stand before residual grounded things that are higher
struct FarHorizon {
  ReceiverPatches patches;
  AzimuthBins bins;
  std::vector<float> low, estimate, high, overhang;
  ExplicitOccluders occluders;

  /// The bins of a patch, in `low`, `estimate`, `high` or `overhang`.
  [[nodiscard]] std::span<const float> row(const std::vector<float>& slopes, std::uint32_t patch) const {
    return std::span(slopes).subspan(static_cast<std::size_t>(patch) * bins.count, bins.count);
  }
  /// The layers, as bits, whose explicit occluders must be met from heights between two: theirs, and the one above, since `estimate`,
  /// which knows only the residual city, is on its way there.
  [[nodiscard]] std::uint32_t layers_met_from(float z_low_m, float z_high_m) const {
    const std::uint32_t lowest = patches.layer_of(z_low_m), highest = patches.layer_of(z_high_m) + 1;
    return (std::uint32_t{2} << highest) - (std::uint32_t{1} << lowest);
  }
  /// The patch above, and how far up the way to its floor a height in `patch` is, from 0 to 1.
  [[nodiscard]] std::pair<std::uint32_t, float> floor_above(std::uint32_t patch, float z_m) const {
    const std::vector<float>& levels_m = patches.levels_m();
    const std::uint32_t layer = patch / patches.squares();
    if (layer + 1 >= levels_m.size()) return {patch, 0.0F};
    const float thickness_m = levels_m[layer + 1] - levels_m[layer];
    return {patch + patches.squares(), thickness_m > 0.0F ? std::max(0.0F, z_m - levels_m[layer]) / thickness_m : 0.0F};
  }
};

}  // namespace farlod
