// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/slab.hpp"

namespace farlod::tiles {

/// What the inside of a closed building tells of its upper borders. Proof in docs/concepts.md, "What is grounded, and what
/// overhangs".
class SolidToGround {
 public:
  /// All slabs of the building.
  explicit SolidToGround(std::span<const Slab> slabs);

  /// Parts of an edge of the building, sorted.
  struct Parts {
    /// All below is hidden: beside it, columns of the solid reach from the facet down to the ground.
    std::vector<ShareStretch> grounded;
    /// The solid lies above it on both sides: no eye outside sees sky there.
    std::vector<ShareStretch> buried;
  };
  [[nodiscard]] Parts parts_of(const Segment3d& edge) const;

 private:
  struct Placed {
    Slab slab;
    Box2d plan;
  };
  class Beside;
  template <class Visit>
  void visit_near(const Box2d& box, const Visit& visit) const;

  std::vector<Placed> slabs_;  ///< from west to east
  double widest_m_ = 0.0;
};

}  // namespace farlod::tiles
