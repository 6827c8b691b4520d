// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "city/geometry.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles {

/// Finds the boxes that meet a box, without looking at all of them: a packed R-tree (Leutenegger et al. 1997).
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box2d>& boxes);

  /// Calls visit(number) for each box that shares a point with `box`, in no order that means anything.
  template <class Visit>
  void for_each_meeting(const Box2d& box, const Visit& visit) const {
    if (!levels_.empty()) descend(levels_.size() - 1, 0, levels_.back().size(), box, visit);
  }

 private:
  static constexpr std::size_t fan_out = 8;

  template <class Visit>
  void descend(std::size_t level, std::size_t begin, std::size_t end, const Box2d& box, const Visit& visit) const {
    for (std::size_t k = begin; k < end; ++k) {
      if (!boxes_meet(levels_[level][k], box)) continue;
      if (level == 0)
        visit(order_[k]);
      else
        descend(level - 1, fan_out * k, std::min(fan_out * (k + 1), levels_[level - 1].size()), box, visit);
    }
  }

  std::vector<std::size_t> order_;          ///< the numbers of the boxes in levels_[0]
  std::vector<std::vector<Box2d>> levels_;  ///< the boxes, and boxes around `fan_out` of the level below
};

/// Where a place lies with regard to a ring, by the even-odd rule.
enum class RingSide { outside, on_ring, inside };

/// An edge from its lower end to its upper one. Of two points with equal y, the one to the west is the lower one: so no edge is
/// level, as if the plane were turned by a very small angle.
struct RisingEdge {
  Point2d low, high;
};

[[nodiscard]] bool is_lower(Point2d a, Point2d b);
[[nodiscard]] RisingEdge rising(Point2d a, Point2d b);
/// Whether two edges cross properly: the ends of each lie strictly on different sides of the other. Exact.
[[nodiscard]] bool edges_cross(const RisingEdge& a, const RisingEdge& b);

/// Edges in a segment tree over the slabs between their ends (Bentley 1977; Chazelle et al. 1994). An edge lies at the nodes
/// whose slab it passes from bottom to top. There, edges that do not cross are ordered from west to east, so that a question
/// looks at the logarithm of their number; those of a node where some cross are looked at one by one. All answers are exact.
class SlabTree {
 public:
  /// `borders`: ends of slabs, in any order, among them all ends of the edges; further ones may be those of edges to be asked
  /// for.
  SlabTree(std::span<const RisingEdge> edges, std::vector<Point2d> borders);

  /// The side of a place with regard to the ring that all edges make up.
  [[nodiscard]] RingSide side_of(Point2d p) const;
  /// Whether an edge, both of whose ends are borders, crosses one of the tree properly. Edges of the tree that lie at nodes below
  /// the highest nodes within the edge's own slabs are not looked at: ask a tree of the other edges for those of this one, too.
  [[nodiscard]] bool crosses(const RisingEdge& edge) const;

 private:
  struct Entry {
    std::uint32_t node = 0, edge = 0;
    double key = 0.0;  ///< about the x in the middle of the slab
  };
  struct Node {
    std::uint32_t begin = 0, end = 0;
    bool is_ordered = true;
  };

  void enter(std::uint32_t edge);
  void order_nodes();
  [[nodiscard]] double key_of(std::uint32_t node, const RisingEdge& edge) const;
  [[nodiscard]] const RisingEdge& edge_at(std::uint32_t entry) const { return edges_[entries_[entry].edge]; }
  [[nodiscard]] std::size_t border_row(Point2d p) const;
  /// How many edges of the node lie to the west of the place; nothing where it lies on one.
  [[nodiscard]] std::optional<std::size_t> west_of(const Node& node, Point2d p) const;
  [[nodiscard]] bool crosses(const Node& node, const RisingEdge& edge) const;

  std::span<const RisingEdge> edges_;
  std::vector<Point2d> borders_;
  std::size_t leaf_count_ = 1;  ///< a power of two
  std::vector<Entry> entries_;  ///< by node
  std::vector<Node> nodes_;     ///< the children of n are 2 n and 2 n + 1; the root is 1
};

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
