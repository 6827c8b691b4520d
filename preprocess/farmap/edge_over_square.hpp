// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "farmap/bin_borders.hpp"

namespace farlod {

/// Bounds give way by this much (and by as much relative to themselves), and azimuths by as much in radians: the rounding of
/// places to floats, seen from a distance. docs/concepts.md, "Bounds from a region".
inline constexpr double bound_rounding = 1e-5;

/// How an edge is seen from anywhere in a square: the azimuth bins in which it can be, and upper and lower bounds of its slope in
/// each. Proof in docs/concepts.md, "Bounds from a region". One object serves many edges, and keeps its memory.
class EdgeOverSquare {
 public:
  /// The borders must outlive it.
  explicit EdgeOverSquare(const BinBorders& borders) : borders_(&borders) {}
  void set_edge(const Point3d& a, const Point3d& b, const Box2d& square);

  /// The edge is so close that it can be in any direction: nothing bounds it.
  [[nodiscard]] bool is_unbounded() const { return is_unbounded_; }
  /// The bins that the edge touches for some eye, counted from `first_bin`, which may lie outside of a turn.
  [[nodiscard]] std::int64_t first_bin() const { return first_bin_; }
  [[nodiscard]] std::size_t bin_count() const { return bin_count_; }

  /// For each bin: no eye at `z_m` or above, anywhere in the square, sees the edge steeper than this within the bin. At least 0.
  /// Valid until the next call of it.
  [[nodiscard]] std::span<const double> high(double z_m);
  /// For each bin: every eye at `z_m` or below, anywhere in the square, sees the edge at least this steep, all over the bin;
  /// 0 when some eye does not see it there. Valid until the next call of it.
  [[nodiscard]] std::span<const double> low(double z_m);

 private:
  /// The line through the edge, seen from one corner of the square at the height z: its slope is slope_at_0 − z · per_metre, for
  /// each border between bins. Infinite where the line does not lie in front.
  struct FromCorner {
    std::vector<double> slope_at_0, per_metre;
  };
  /// The tangent, aside / ahead, of the angle from one direction counter-clockwise to another, by less than a right angle:
  /// compared without a division.
  struct Turn {
    double aside = 0.0, ahead = 1.0;
    bool operator<(const Turn& o) const { return aside * o.ahead < o.aside * ahead; }
  };
  /// Between these angles the edge lies for some eye of the square; between the common ones, if any, for all eyes. Counted from
  /// the direction between the centres of square and edge.
  struct Turns {
    Turn from, to, common_from, common_to;
  };
  [[nodiscard]] static Turn turn_to(Point2d d, Point2d toward) {
    return {toward.x * d.y - toward.y * d.x, toward.x * d.x + toward.y * d.y};
  }
  /// The other way, but for the length.
  [[nodiscard]] static Point2d direction_of(const Turn& turn, Point2d toward) {
    return {toward.x * turn.ahead - toward.y * turn.aside, toward.y * turn.ahead + toward.x * turn.aside};
  }
  /// None when an end can lie beside or behind.
  [[nodiscard]] std::optional<Turns> turns_over(Point2d toward);
  void find_bins(const Turns& turns, Point2d toward);
  void evaluate_borders();

  const BinBorders* borders_;
  Point3d a_, b_;
  std::array<Point2d, 4> corners_;
  double nearest_m_ = 0.0;
  bool is_unbounded_ = false, one_sided_ = false, borders_known_ = false;
  std::int64_t first_bin_ = 0;
  std::size_t bin_count_ = 0, common_begin_ = 0, common_end_ = 0;
  std::array<FromCorner, 4> from_corner_;
  double high_at_m_ = 0.0, low_at_m_ = 0.0;  ///< the heights that `high_` and `low_` are for
  std::vector<double> across_, steepest_, high_, low_;
};

}  // namespace farlod
