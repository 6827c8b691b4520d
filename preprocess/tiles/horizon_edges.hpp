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

/// A segment that can be a horizon, and the facets beside it.
struct HorizonSegment {
  Segment3d segment;
  EdgeRises rises;
  bool operator==(const HorizonSegment&) const = default;
};

/// Two directions closer than this cannot be told apart. Turning a city into the grid frame rounds its points by less than
/// 1e-10 m (a double has 53 bits, a city less than 400 km); over `least_extent_m` that makes this angle.
inline constexpr double angle_tolerance_rad = 1e-6;
inline constexpr double least_extent_m = 1e-4;
/// An edge that covers less ground than this is upright: rounding to the floats of a tile moves its ends farther.
inline constexpr double upright_m = 1e-6;

/// An edge and what its triangles do beside it: enough to tell whether it can ever be a horizon.
/// Proof in docs/stages/tiles.md, "Horizon edges".
class EdgeSides {
 public:
  EdgeSides(const Point3d& a, const Point3d& b) : edge_{a, b} {}

  /// Takes in a triangle of the edge, by its third corner.
  void add(const Point3d& opposite);
  [[nodiscard]] const Segment3d& edge() const { return edge_; }
  [[nodiscard]] std::uint32_t triangle_count() const { return triangle_count_; }
  [[nodiscard]] EdgeRises rises() const { return {EdgeRises::rounded_down(left_rad_), EdgeRises::rounded_down(right_rad_)}; }
  /// False: whatever eye looks past the edge sees one of its triangles at least as high as the edge.
  [[nodiscard]] bool can_be_horizon() const;

 private:
  Segment3d edge_;
  std::uint32_t triangle_count_ = 0;
  bool under_wall_ = false;  ///< a vertical triangle rises from it
  /// The steepest triangle on either side, as seen from above: the angle by which it rises away from the edge.
  double left_rad_ = -std::numeric_limits<double>::infinity(), right_rad_ = -std::numeric_limits<double>::infinity();
};

/// The edges of a heap of triangles. Edges are one when both their ends are equal, bit for bit.
class EdgeTable {
 public:
  void add_triangle(const Point3d& a, const Point3d& b, const Point3d& c);

  /// Each edge that can be a horizon, once, in the order in which they were added.
  [[nodiscard]] std::vector<HorizonSegment> horizon_edges() const;
  /// Edges of an odd number of triangles, in the order in which they were added. A closed surface has none.
  [[nodiscard]] std::vector<Segment3d> open_edges() const;

 private:
  struct Hash {
    std::size_t operator()(const Segment3d& s) const;
  };
  void add_edge(const Point3d& a, const Point3d& b, const Point3d& opposite);

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
