// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "tiles/box_tree.hpp"
#include "tiles/slab_tree.hpp"

namespace farlod::tiles {

/// A ring in the plane that is asked again and again where something lies with regard to it. What is searched instead of its
/// edges is made once it pays, so that small rings and single questions cost no more than a look at each edge. Exact.
class RingSides {
 public:
  explicit RingSides(std::vector<Point2d> ring);
  RingSides(const RingSides&) = delete;  // its trees look at its edges
  RingSides& operator=(const RingSides&) = delete;
  RingSides(RingSides&&) = default;
  RingSides& operator=(RingSides&&) = default;
  ~RingSides() = default;

  [[nodiscard]] const std::vector<Point2d>& points() const { return ring_; }
  [[nodiscard]] const Box2d& box() const { return box_; }
  [[nodiscard]] RingSide side_of(Point2d p);
  /// The side of another ring that does not cross this one: that of its first corner that is not on the ring, else of the first
  /// midpoint of an edge that is not.
  [[nodiscard]] RingSide side_of(const RingSides& other);
  /// Whether corners of one ring lie on both sides of the other, or edges cross properly.
  [[nodiscard]] bool crosses(RingSides& other);
  /// What the questions have cost so far, in edges and corners looked at.
  [[nodiscard]] std::size_t work() const { return work_; }

 private:
  [[nodiscard]] std::vector<RisingEdge> edges_meeting(const Box2d& box);
  /// Whether corners of `other` lie on both sides. `near`: those of its edges that meet the box of this ring.
  [[nodiscard]] bool has_on_both_sides(const RingSides& other, const std::vector<RisingEdge>& near);

  std::vector<Point2d> ring_;
  Box2d box_;
  std::vector<RisingEdge> edges_;
  std::optional<SlabTree> slabs_;
  std::optional<BoxTree> edge_boxes_;
  std::size_t work_ = 0, linear_searches_ = 0;
};

}  // namespace farlod::tiles
