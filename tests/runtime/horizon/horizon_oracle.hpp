// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"

// Horizons edge by edge and azimuth by azimuth, in double: what the kernels must find, and how far floats may lead them astray.

namespace farlod {

/// Rounding of a float, relative.
inline constexpr double float_rounding = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());

/// Where an edge ends, in radians: one rounding of its place, one of the azimuth that is asked, and those of two products and
/// their difference, each at most √2 of a rounding off.
inline constexpr double azimuth_rounding_rad = 5.0 * 1.4143 * float_rounding;

/// An edge that is seen end-on within this (sine of the angle) may be left out; one that is overhead may hide either side.
inline constexpr double end_on_sine = 1.1e-5;

struct SlopeRange {
  double low = 0.0, high = 0.0;
};

/// An edge relative to an eye. Both have float coordinates: their differences are exact here.
class EdgeOracle {
 public:
  EdgeOracle(const HorizonEdge& e, const Point3f& eye, double error_rad)
      : a_(seen(e.a, eye)), b_(seen(e.b, eye)), error_rad_(error_rad) {}

  /// Between which slopes the horizon lies that this edge alone makes, at the azimuth of a unit vector.
  [[nodiscard]] SlopeRange at(Point2d u) const {
    if (std::max(a_.z, b_.z) <= 0.0 || lengths() == 0.0) return {};
    // Right below an edge, what it hides is up to its sides
    const bool is_below = std::abs(turn()) <= end_on_sine * lengths() && dot(horizontal(a_), horizontal(b_)) < 0.0;
    if (is_below) return {0.0, std::numeric_limits<double>::infinity()};
    const double inside = std::min(beyond(a_, u), beyond(u, b_));
    if (turn() == 0.0 || inside < -error_rad_) return {};
    const double slope = (across(a_, b_.z, u) - across(b_, a_.z, u)) / turn(), error = slope_error(slope);
    const bool is_sure = inside > error_rad_ && std::abs(turn()) > end_on_sine * lengths();
    return {is_sure ? std::max(0.0, slope - error) : 0.0, std::max(0.0, slope + error)};
  }

 private:
  static Point3d seen(const Point3f& p, const Point3f& eye) {
    return {double{p.x} - double{eye.x}, double{p.y} - double{eye.y}, double{p.z} - double{eye.z}};
  }
  [[nodiscard]] double turn() const { return a_.x * b_.y - a_.y * b_.x; }
  [[nodiscard]] double lengths() const { return norm(horizontal(a_)) * norm(horizontal(b_)); }
  /// Sine of the angle from one to the other, positive in the sense in which the edge runs from a to b.
  [[nodiscard]] double beyond(const Point3d& p, Point2d u) const {
    return sense() * (p.x * u.y - p.y * u.x) / norm(horizontal(p));
  }
  [[nodiscard]] double beyond(Point2d u, const Point3d& p) const {
    return sense() * (u.x * p.y - u.y * p.x) / norm(horizontal(p));
  }
  [[nodiscard]] double sense() const { return turn() < 0.0 ? -1.0 : 1.0; }
  static double across(const Point3d& p, double z, Point2d u) { return z * (p.x * u.y - p.y * u.x); }

  /// Two products for each end, and for the turn: with the differences from the eye, and the azimuth, that are five roundings
  /// each, of the sum of what is added, not of what remains. A division, a product by it and by the height, which is a
  /// difference, and the sum of both ends: another five, and as much again to spare.
  [[nodiscard]] double slope_error(double slope) const {
    const double added = std::abs(a_.y * b_.z) + std::abs(a_.z * b_.y) + std::abs(a_.z * b_.x) + std::abs(a_.x * b_.z);
    return 16.0 * float_rounding * (added + std::abs(slope) * lengths()) / std::abs(turn());
  }

  Point3d a_, b_;
  double error_rad_;
};

/// The same for many edges together.
[[nodiscard]] inline SlopeRange expected_horizon(std::span<const HorizonEdge> edges, const Point3f& eye, Point2d u) {
  SlopeRange all;
  for (const HorizonEdge& e : edges) {
    const SlopeRange one = EdgeOracle(e, eye, azimuth_rounding_rad).at(u);
    all = {std::max(all.low, one.low), std::max(all.high, one.high)};
  }
  return all;
}

}  // namespace farlod
