// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/slab.hpp"

namespace farlod::tiles {

/// What is narrower comes from the rounding of coordinates.
inline constexpr double least_sliver_m = 5e-5;

/// What the inside of a closed building tells of its upper borders. Proof in docs/concepts.md, "What is grounded, and what
/// overhangs".
class SolidToGround {
 public:
  /// All slabs of the building.
  explicit SolidToGround(std::span<const Slab> slabs);

  /// A place where the solid is hollow, such as that of a window set back: a rectangle of the plan that is open on one side,
  /// stands on columns of the solid on the other three, and is covered by a layer of it which no ceiling reaches through.
  struct Recess {
    Point2d begin, along, aside;  ///< its frame: unit vectors
    Box2d plan;                   ///< in it: along the open side, and inwards
    double layer_m = 0.0;         ///< a height in the layer
    /// The part of an edge that lies over it: grounded for all eyes but those in the recess.
    [[nodiscard]] std::optional<ShareStretch> stretch_over(const Segment3d& edge) const;
  };

  /// Parts of an edge of the building, sorted.
  struct Parts {
    /// All below is hidden: beside it, columns of the solid reach from the facet down to the ground.
    std::vector<ShareStretch> grounded;
    /// The facet is there, but its columns are not: for recesses to tell.
    std::vector<ShareStretch> hollow;
    /// The solid lies above it on both sides: no eye outside sees sky there.
    std::vector<ShareStretch> buried;
  };
  /// Adds the recesses below the edge.
  [[nodiscard]] Parts parts_of(const Segment3d& edge, std::vector<Recess>& recesses) const;
  /// The parts of a lower border with the solid on both sides, above and below.
  [[nodiscard]] std::vector<ShareStretch> buried_parts_of(const Segment3d& underside) const;

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
