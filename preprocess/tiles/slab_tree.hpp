// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::tiles {

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

}  // namespace farlod::tiles
