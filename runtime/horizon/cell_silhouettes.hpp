// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "base/grid.hpp"
#include "horizon/silhouette_edges.hpp"
#include "package/far_map.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Upper and lower borders of overhangs: EdgeRole::overhang and EdgeRole::underside.
struct OverhangEdges {
  SilhouetteEdges overhangs{EdgeRole::overhang}, undersides{EdgeRole::underside};
  [[nodiscard]] bool empty() const { return overhangs.empty() && undersides.empty(); }
};

/// The silhouette edges of the city for receivers of one cell, but for those that its far map merged into the residual horizon.
/// Cell frame.
/// Overhangs of the neighborhood, and explicit ones of the far city.
struct CellOverhangs {
  OverhangEdges near, far;
  [[nodiscard]] bool empty() const { return near.empty() && far.empty(); }
  [[nodiscard]] bool has_undersides() const { return !near.undersides.empty() || !far.undersides.empty(); }
};

struct CellSilhouettes : CellOverhangs {
  SilhouetteEdges grounded;  ///< near and far
  /// Those that may lie over recesses (most_recess_depth_m) of receivers in the box, whether they face them or not.
  std::vector<HorizonEdge> over_recesses;
  BorderEnds upper_ends;  ///< of the upper borders: `grounded`, near.overhangs, far.overhangs, which are numbered in this order

  /// Numbers the upper borders, and the lower ones by themselves (near, far); finds the ends of the upper ones.
  void number_borders();
};

/// The edges of the cells nearby (near_cells_of), the explicit edges of the far map, and those of a far terrain in its own frame,
/// where that is in no far map; without those that face away from all receivers in a box.
[[nodiscard]] CellSilhouettes cell_silhouettes(const PackageReader& package, Cell cell, const FarHorizon& far,
                                               const ReceiverBox& box, std::span<const HorizonEdge> far_terrain = {});

/// The box around some receivers.
[[nodiscard]] ReceiverBox bounding_box(std::span<const Receiver> receivers);

}  // namespace farlod
