// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/slab.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {

/// The plan of a building that grounded walls surround, where all upper borders hide what is below them: of a house with eaves,
/// all but the eaves. Proof in docs/concepts.md, "What is grounded, and what overhangs".
class WalledIn {
 public:
  /// `loose_edges`: those of an odd number of triangles. Nothing is walled in, unless
  ///   (1) the walls form rings,
  ///   (2) nothing passes over them above their upper borders, and
  ///   (3) between them, there is neither a loose edge nor a slab that looks down, but for what stands on the ground.
  WalledIn(std::span<const WallProfile> walls, std::span<const Slab> slabs, std::span<const Segment3d> loose_edges);

  /// The parts of a segment that lie within the walls, or on them; sorted.
  [[nodiscard]] std::vector<ShareStretch> stretches_of(const Segment3d& segment) const;

 private:
  struct Side {
    Point2d a, b;
  };
  void add(const WallProfile& wall);
  [[nodiscard]] Point2d corner_at(Point2d p) const;
  [[nodiscard]] bool form_rings() const;
  [[nodiscard]] bool holds(Point2d p) const;
  [[nodiscard]] double distance_m(Point2d p) const;

  std::vector<Side> sides_;  ///< of the plan
  Box2d box_;
};

}  // namespace farlod::tiles
