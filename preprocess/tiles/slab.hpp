// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

/// A triangle of a building that is not vertical: of a roof, a floor, a soffit.
struct Slab {
  std::array<Point3d, 3> corners;  ///< grid frame
  FacetLook look = FacetLook::up;
  bool on_ground = false;  ///< it stands on the ground, or on a foundation

  /// The height of its plane.
  [[nodiscard]] double height_m(Point2d p) const;
};

/// The triangle as a slab; nothing if it counts as vertical, as beside an underside.
[[nodiscard]] std::optional<Slab> slab_of(const std::array<Point3d, 3>& triangle, FacetLook look);

/// The part of the way from one place to another that lies in the plan of a slab.
[[nodiscard]] std::optional<ShareStretch> part_within(const Slab& slab, Point2d from, Point2d to);

}  // namespace farlod::tiles
