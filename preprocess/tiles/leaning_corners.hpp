// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <set>
#include <span>
#include <vector>

#include "city/geometry.hpp"
#include "farlod/point.hpp"
#include "tiles/contacts.hpp"
#include "tiles/ground.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

/// A steep edge that leans by some millimetres.
struct LeaningCorner {
  Segment3d segment;  ///< from its upper end
  /// Its facets in the plan, as they leave it: level ways within each.
  std::vector<Point2d> facets;

  /// How far the upper end stands out in the plan beyond the foot and all that its facets cover, m.
  [[nodiscard]] double stands_out_m() const;
};

/// The corners of a building among its edges, without their facets.
[[nodiscard]] std::vector<LeaningCorner> leaning_corners(std::span<const EdgeSides> edges);
/// Adds a triangle to the corners that are sides of it.
void add_facet(const std::array<Point3d, 3>& triangle, std::vector<LeaningCorner>& corners);

/// Places, each once.
using Places = std::set<Point3d, decltype(&comes_first)>;
[[nodiscard]] Places ends_of(std::span<const HorizonSegment> borders);

/// What closes the air below corners that stand out, down to the ground: below the ends of grounded borders, and below the feet
/// of such corners. Nothing is seen below a grounded border.
[[nodiscard]] std::vector<ClosingTriangle> closing_below(std::vector<LeaningCorner> corners, const Places& ends_of_grounded,
                                                         const GroundHeightAt& ground_height);

}  // namespace farlod::tiles
