// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
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

/// What eyes anywhere in a square see of an edge: in which azimuth bins it can stand, and how steep it can be at the most and is
/// at the least. Proof in docs/concepts.md, "Bounds from a region". One object looks at many edges, and keeps its memory.
class EdgeOverSquare {
 public:
  /// The borders must outlive it.
  explicit EdgeOverSquare(const BinBorders& borders) : borders_(&borders) {}
  void look_at(const Point3d& a, const Point3d& b, const Box2d& square);

  /// The edge is so close that it can stand in any direction: nothing can be said.
  [[nodiscard]] bool surrounds() const { return surrounds_; }
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
  /// For each border, slope = rise − z · per_metre of the edge's line, seen from one corner of the square; infinite where the
  /// line does not lie in front.
  struct FromCorner {
    std::vector<double> rise, per_metre;
  };
  /// How far to the left of a direction another one lies, by less than a right angle: compared without an arc tangent.
  struct Turn {
    double aside = 0.0, ahead = 1.0;
    bool operator<(const Turn& o) const { return aside * o.ahead < o.aside * ahead; }
  };
  /// From the middle's azimuth to the ends, over all eyes; and those that the edge covers for each eye.
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
  void find_range(const Turns& turns, Point2d toward);
  void evaluate_borders();

  const BinBorders* borders_;
  Point3d a_, b_;
  std::array<Point2d, 4> corners_;
  double nearest_m_ = 0.0;
  bool surrounds_ = false, one_sided_ = false, borders_known_ = false;
  std::int64_t first_bin_ = 0;
  std::size_t bin_count_ = 0, common_begin_ = 0, common_end_ = 0;
  std::array<FromCorner, 4> from_corner_;
  double upper_at_m_ = 0.0, lower_at_m_ = 0.0;  ///< the heights that `upper_` and `lower_` are for
  std::vector<double> across_, steepest_, upper_, lower_;
};

}  // namespace farlod
