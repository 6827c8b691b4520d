// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// A part of the turn: the unit vector of its first azimuth (plan), and the tangent of its width, less than a right angle.
struct Wedge {
  Point2d from;
  double tangent = 0.0;
};

/// What a receiver sees of a wedge, in the plane at the distance 1 along the wedge's first azimuth: τ to the left from 0 to the
/// tangent of the wedge, y up. A straight line in space is a straight line here, as are the level (y = 0) and the receiver's own
/// plane. docs/concepts.md, "The sky of a wedge".
class PicturePlane {
 public:
  struct Place {
    double t = 0.0, y = 0.0;
  };
  /// A straight line from one place to another one that is not left of it.
  struct Segment {
    Segment(const Place& from, const Place& to)
        : left(from), right(to), rise(to.t > from.t ? (to.y - from.y) / (to.t - from.t) : 0.0) {}
    [[nodiscard]] double at(double t) const { return left.y + rise * (t - left.t); }
    Place left, right;
    double rise;
  };

  /// ∫ F(φ) dφ over the wedge; and the least y of what is seen of it, infinite where nothing is.
  struct Sky {
    double sky = 0.0, lowest = std::numeric_limits<double>::infinity();
  };

  /// For a receiver of this normal, of length 1.
  PicturePlane(const Wedge& wedge, const Point3d& normal, SkyWeight weight);

  [[nodiscard]] double tangent() const { return wedge_.tangent; }
  /// A vector by its parts along the wedge's first azimuth, to the left of it, and up.
  [[nodiscard]] Point3d in_wedge(const Point3d& v) const {
    const Point2d d = wedge_.from;
    return {v.x * d.x + v.y * d.y, v.y * d.x - v.x * d.y, v.z};
  }
  /// Below this the receiver has no sky, whatever stands there: the level, or its own plane where that is higher. From left to
  /// right, without a gap; nothing where the wedge is behind a receiver that does not look up.
  [[nodiscard]] std::span<const Segment> floor() const { return {floor_.data(), parts_}; }
  /// ∫ F(φ) dφ above a segment that is nowhere below the floor (F as in "Above a horizon"): up to the zenith, or to the own plane
  /// of a receiver that looks down.
  [[nodiscard]] double sky_above(const Place& left, const Place& right) const;

 private:
  void add_floor(double from, double to, bool is_in_front);
  /// The receiver's own plane.
  [[nodiscard]] Place plane_at(double t) const { return {t, -(normal_.x + normal_.y * t) / normal_.z}; }
  [[nodiscard]] double sky_up_to_zenith(const Place& left, const Place& right) const;

  Wedge wedge_;
  Point3d normal_;  ///< in_wedge
  SkyWeight weight_;
  std::array<Segment, 2> floor_{Segment{{}, {}}, Segment{{}, {}}};
  std::size_t parts_ = 0;
};

}  // namespace farlod
