// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>

#include "view/tile_surfaces.hpp"

namespace farlod {

/// A point of a lattice, which all vertices near it move to.
struct ClusterPlace {
  std::int32_t x = 0, y = 0, z = 0;
  auto operator<=>(const ClusterPlace&) const = default;
};

/// In the plan, vertices go to the nearest point of a lattice that divides the square's edges evenly; in height, to the mean of
/// those that have the same nearest level. With a step s they move by s/√2 in the plan, and by s in height at the most: √1.5 s.
class ClusterLattice {
 public:
  ClusterLattice(const ViewFrame& frame, const TileSquare& square, double error_m);

  [[nodiscard]] ClusterPlace place_of(const Point3d& p_local) const;
  [[nodiscard]] Point2d point_local(const ClusterPlace& place) const;

 private:
  const ViewFrame& frame_;
  TileSquare square_;
  double step_m_;
};

/// Simplifies what is drawn of a tile: vertices near each other become one, and facets that are a line or a point then are left
/// out. Of facets that then cover one another, the one that looks up the most stays. Ground and buildings do not share vertices.
///   (1) no vertex moves by more than `error_m`
///   (2) one on the border of the square stays on it, and moves as the neighboring tile's does, but for its height
void move_into_clusters(const ViewFrame& frame, const TileSquare& square, double error_m, TileSurfaces& surfaces);

}  // namespace farlod
