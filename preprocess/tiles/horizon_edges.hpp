// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "farlod/grid.hpp"
#include "farlod/horizon/horizon_edge.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// A straight piece in the grid frame.
struct Segment3d {
  Point3d a, b;
  bool operator==(const Segment3d&) const = default;
};

/// A segment that can be a silhouette, and the facets beside it.
struct HorizonSegment {
  Segment3d segment;
  AdjacentSlopes adjacent;
  EdgeRole role = EdgeRole::grounded;
  bool operator==(const HorizonSegment&) const = default;
};

/// Two directions closer than this cannot be told apart. Turning a city into the grid frame rounds its points by less than
/// 1e-10 m (a double has 53 bits, a city less than 400 km); over `least_extent_m` that makes this angle.
inline constexpr double angle_tolerance_rad = 1e-6;
inline constexpr double least_extent_m = 1e-4;
/// An edge that covers less ground than this is upright: rounding to the floats of a tile moves its ends farther.
inline constexpr double upright_m = 1e-6;
/// A facet that leans by less than this (cosine) counts as upright where something might be seen under it: it was surveyed a
/// little off.
inline constexpr double leaning_wall_z = 0.01;
/// Facets that bend by less than this are one where they might be seen under; and the facets beside a lower border count as
/// flatter by four times as much, so that it stands for the bends nearby that are left out.
inline constexpr double slight_bend_rad = 0.005;

/// Which side of a facet is outside.
enum class FacetLook : std::uint8_t { up, down };

/// An edge and what its triangles do beside it: enough to tell whether it can ever be a horizon.
/// Proof in docs/stages/tiles.md, "Horizon edges".
class EdgeSides {
 public:
  EdgeSides(const Point3d& a, const Point3d& b) : edge_{a, b} {}

  /// Takes in a triangle of the edge, by its third corner, and by what it looks at outwards: a soffit looks down.
  void add(const Point3d& opposite, FacetLook look);
  [[nodiscard]] const Segment3d& edge() const { return edge_; }
  [[nodiscard]] std::uint32_t triangle_count() const { return triangle_count_; }
  [[nodiscard]] AdjacentSlopes adjacent() const { return {AdjacentSlopes::rounded_down(left_rad_), AdjacentSlopes::rounded_down(right_rad_)}; }
  /// False: whatever eye looks past the edge sees one of its triangles at least as high as the edge.
  [[nodiscard]] bool can_be_horizon() const;
  /// As HorizonEdge::rises of a lower border.
  [[nodiscard]] AdjacentSlopes lowest_adjacent_slopes() const;
  /// Facets that look up bend upwards here, as in a valley between roofs. In a closed building nobody sees that from below.
  [[nodiscard]] bool is_valley() const;
  /// False: whatever eye looks past the edge from below sees one of its triangles reach at least as low.
  [[nodiscard]] bool can_be_underside() const;
  /// A wall hangs from it, or a facet falls away from it: it may close what another edge in the same place leaves open.
  [[nodiscard]] bool has_facet_below() const { return over_wall_ || left_low_rad_ < 0.0 || right_low_rad_ < 0.0; }
  /// Takes in the facets beside another edge on the same line.
  void add_sides_of(const EdgeSides& other);

 private:
  Segment3d edge_;
  std::uint32_t triangle_count_ = 0;
  bool under_wall_ = false;                     ///< a vertical triangle rises from it
  bool over_wall_ = false;                      ///< a triangle that is vertical, or nearly, hangs from it
  bool has_roof_ = false, has_soffit_ = false;  ///< a triangle that is not, and looks up, or down
  /// The steepest triangle on either side, as seen from above: the angle by which it rises away from the edge.
  double left_rad_ = -std::numeric_limits<double>::infinity(), right_rad_ = -std::numeric_limits<double>::infinity();
  /// The flattest, or the one that falls steepest, likewise.
  double left_low_rad_ = std::numeric_limits<double>::infinity(), right_low_rad_ = std::numeric_limits<double>::infinity();
};

/// The edges of a heap of triangles. Edges are one when both their ends are equal, bit for bit.
class EdgeTable {
 public:
  void add_triangle(const Point3d& a, const Point3d& b, const Point3d& c, FacetLook look);

  /// Each edge, once, in the order in which they were added.
  [[nodiscard]] const std::vector<EdgeSides>& edges() const { return edges_; }
  /// Those that can be a horizon.
  [[nodiscard]] std::vector<HorizonSegment> horizon_edges() const;

 private:
  struct Hash {
    std::size_t operator()(const Segment3d& s) const;
  };
  void add_edge(const Point3d& a, const Point3d& b, const Point3d& opposite, FacetLook look);

  std::vector<EdgeSides> edges_;
  std::unordered_map<Segment3d, std::size_t, Hash> place_of_;
};

/// A horizon edge, or what of it lies in one cell, rounded to the cell frame.
struct CellEdge {
  Cell cell;
  HorizonEdge edge;
};

/// Cuts an edge at the borders of the grid, and rounds the ends of the pieces once. A piece belongs to the cell of its
/// middle: along a border, to the one to its east or north.
[[nodiscard]] std::vector<CellEdge> cut_edge(const HorizonSegment& edge_grid, const Grid& grid, double height_origin_m);

/// An edge left whole, in the frame of `cell`.
[[nodiscard]] CellEdge whole_edge(const HorizonSegment& edge_grid, Cell cell, const Grid& grid, double height_origin_m);

}  // namespace farlod
