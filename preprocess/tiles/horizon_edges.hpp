// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"
#include "package/upper_facets.hpp"
#include "tiles/contacts.hpp"

namespace farlod::tiles {

/// A straight segment in the grid frame.
struct Segment3d {
  Point3d a, b;
  bool operator==(const Segment3d&) const = default;
};

[[nodiscard]] inline Point3d point_at(const Segment3d& s, double share) { return s.a + share * (s.b - s.a); }

/// A part of a segment, in shares of its length.
struct ShareStretch {
  double from = 0.0, to = 1.0;
};
/// `stretches` without the part `taken`.
[[nodiscard]] std::vector<ShareStretch> without(const std::vector<ShareStretch>& stretches, const ShareStretch& taken);
[[nodiscard]] std::vector<ShareStretch> without(std::vector<ShareStretch> stretches, const std::vector<ShareStretch>& taken);
/// The stretches sorted, those joined that are at most `give` apart.
[[nodiscard]] std::vector<ShareStretch> joined(std::vector<ShareStretch> stretches, double give);
/// The same; at both ends too, and without those that are no longer than `give`.
[[nodiscard]] std::vector<ShareStretch> tidied(std::vector<ShareStretch> stretches, double give);

/// A segment that can be a silhouette, and the slopes of the facets beside it.
struct HorizonSegment {
  Segment3d segment;
  AdjacentSlopes adjacent;
  EdgeRole role = EdgeRole::grounded;
  bool operator==(const HorizonSegment&) const = default;
};

/// For undersides, a facet or an edge counts as vertical when its tangent from the vertical is below this, and when it leans by
/// no more than max_lean_m in all. Surveyed walls lean by as much.
inline constexpr double leaning_wall_z = 0.01;
/// For undersides, two facets that meet at a smaller angle than this count as one plane. A lower border stands for such bends
/// nearby, which are not stored; its adjacent slopes are therefore stored four times this angle higher.
inline constexpr double slight_bend_rad = 0.005;
/// For undersides, a point lies on the line of an edge when it is nearer than this. Rounding to millimetres moves each of the
/// three points by up to √3/2 mm.
inline constexpr double on_line_m = 0.002;

/// Whether the outward normal of a facet points upwards or downwards. A soffit looks down.
enum class FacetLook : std::uint8_t { up, down };

/// An edge and the triangles beside it, as far as silhouettes need them. Sides and rises are those of UpperFacets.
class EdgeSides {
 public:
  EdgeSides(const Point3d& a, const Point3d& b) : edge_{a, b} {}

  /// Adds a triangle of the edge, given by its third corner.
  void add(const Point3d& opposite, FacetLook look);
  [[nodiscard]] const Segment3d& edge() const { return edge_; }
  [[nodiscard]] std::uint32_t triangle_count() const { return triangle_count_; }
  [[nodiscard]] AdjacentSlopes adjacent() const { return upper_.adjacent(); }
  /// False: from every eye, one of the triangles reaches at least as high as the edge wherever the edge is seen.
  [[nodiscard]] bool can_be_horizon() const { return upper_.can_be_horizon(edge_.a, edge_.b); }
  /// The slopes that HorizonEdge::adjacent holds for a lower border.
  [[nodiscard]] AdjacentSlopes lowest_adjacent_slopes() const;
  /// The edge is a valley between facets that look up, as between two roofs. Below it lies the inside of a closed building.
  [[nodiscard]] bool is_valley() const;
  /// It runs so little in the plan that no triangle counts as lying above or below it, though it may lean by some millimetres.
  [[nodiscard]] bool counts_as_upright() const;
  /// False: from every eye below the edge, one of the triangles reaches at least as low as the edge wherever the edge is seen.
  [[nodiscard]] bool can_be_underside() const;
  /// A triangle continues below the edge: a wall, or a facet that falls. It may close what another edge on the same line leaves
  /// open.
  [[nodiscard]] bool has_facet_below() const { return over_wall_ || left_low_rad_ < 0.0 || right_low_rad_ < 0.0; }
  /// Adds the triangles of another edge on the same line.
  void add_sides_of(const EdgeSides& other);

 private:
  Segment3d edge_;
  UpperFacets upper_;
  std::uint32_t triangle_count_ = 0;
  bool over_wall_ = false;                      ///< a vertical or nearly vertical triangle lies below the edge
  bool has_roof_ = false, has_soffit_ = false;  ///< a triangle that is not vertical looks up, or down
  /// The smallest rise on either side; infinity without a triangle.
  double left_low_rad_ = std::numeric_limits<double>::infinity(), right_low_rad_ = std::numeric_limits<double>::infinity();
};

/// The edges of a set of triangles. Two edges are the same when both ends are equal, bit for bit.
class EdgeTable {
 public:
  /// Makes room for so many edges.
  void reserve(std::size_t edges) { edges_.reserve(edges); }
  void add_triangle(const Point3d& a, const Point3d& b, const Point3d& c, FacetLook look);

  /// Each edge once, in the order of insertion.
  [[nodiscard]] const std::vector<EdgeSides>& edges() const { return edges_; }
  /// The edges that can be a horizon.
  [[nodiscard]] std::vector<HorizonSegment> horizon_edges() const;

 private:
  void add_edge(const Point3d& a, const Point3d& b, const Point3d& opposite, FacetLook look);
  [[nodiscard]] std::uint32_t& slot_of(const Segment3d& key);
  void grow();

  static constexpr std::uint32_t no_edge = 0xFFFFFFFF;
  std::vector<EdgeSides> edges_;
  /// A hash table with open addressing: places in edges_, at least half of the slots free. A node for each edge would take as
  /// long to make as all the rest.
  std::vector<std::uint32_t> slots_;
};

/// The lower borders of the facets of a building: the edges, or parts of edges, below which no facet continues.
///   (1) Cut the building by the vertical half-plane through any eye outside of it. Each connected piece of the cut ends below on
///       one of these borders, or is connected with a piece that does not.
///   (2) Where a long edge meets a chain of shorter ones (a T-junction), the facets of both count.
/// A border on the ground shows no sky below it. The ground is not known here, so such borders are among the result.
/// Adds the triangles that close what edges on one line leave open between them, since lines are off by millimetres.
[[nodiscard]] std::vector<HorizonSegment> undersides(std::span<const EdgeSides> edges, std::vector<ClosingTriangle>& closing);

/// A horizon edge, or its part in one cell, rounded to the cell frame.
struct CellEdge {
  Cell cell;
  HorizonEdge edge;
};

/// Cuts an edge at the borders of the grid, and rounds the ends of each piece once. A piece belongs to the cell of its midpoint;
/// on a border, to the cell to the east or north.
[[nodiscard]] std::vector<CellEdge> cut_edge(const HorizonSegment& horizon, const Grid& grid, double height_origin_m);

/// As `cut_edge`; but where there is an `only_cell`, the edge goes whole to it, and wherever it lies.
[[nodiscard]] std::vector<CellEdge> cut_edge_unless_whole(const HorizonSegment& edge_grid, const std::optional<Cell>& only_cell,
                                                          const Grid& grid, double height_origin_m);

}  // namespace farlod::tiles
