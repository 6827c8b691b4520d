// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/sky_partition.hpp"
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

// Sky view factors above horizons, by quadrature in double.

/// What one azimuth gives, where the normal has the parts `outward` along it and `upward`, above a slope: cosine 2∫ n·d cos θ dθ,
/// solid angle ∫ cos θ dθ, over the elevations θ that are looked at and free. Simpson's rule with 200 intervals of at most π/400:
/// its error is below (π/400)⁴·(π/2)/180·16·2 < 2e-9.
[[nodiscard]] inline double expected_sky_of_azimuth(SkyWeight weight, double outward, double upward, double slope) {
  double from = std::atan(slope), to = 0.5 * std::numbers::pi;
  if (outward <= 0.0 && upward <= 0.0) return 0.0;
  if (outward < 0.0) from = std::max(from, std::atan2(-outward, upward));
  if (upward < 0.0) to = std::min(to, std::atan2(outward, -upward));
  if (from >= to) return 0.0;
  const auto seen = [&](double elevation) {
    const double along = std::cos(elevation);
    return weight == SkyWeight::cosine ? 2.0 * (outward * along + upward * std::sin(elevation)) * along : along;
  };
  constexpr int intervals = 200;
  const double step = (to - from) / intervals;
  double sum = seen(from) + seen(to);
  for (int n = 1; n < intervals; ++n) sum += (n % 2 == 1 ? 4.0 : 2.0) * seen(from + n * step);
  return sum * step / 3.0;
}
inline constexpr double quadrature_error = 2e-9;

/// The mean over the azimuths of a ring.
template <class SlopeAt>
[[nodiscard]] double expected_sky(SkyWeight weight, const Point3f& normal, const AzimuthSampling& ring, const SlopeAt& slope_at) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const double outward = double{normal.x} * double{ring.cosine()[k]} + double{normal.y} * double{ring.sine()[k]};
    sum += expected_sky_of_azimuth(weight, outward, normal.z, slope_at(k));
  }
  return std::clamp(sum / static_cast<double>(ring.size()), 0.0, 1.0);
}

/// What floats may be off: each azimuth gives at most 1 + π/2, by some thirty roundings of as much; adding them one by one rounds
/// each sum of a block of 256, and adding the blocks with compensation rounds twice. The slope at which a tilted receiver begins
/// or ceases to look, −outward/upward, is rounded with the reciprocal of the normal's rise.
[[nodiscard]] inline double sky_rounding(std::size_t azimuths, const Point3f& normal) {
  const double added = static_cast<double>(std::min<std::size_t>(azimuths, 256)) + 2.0;
  const double terms = (1.0 + 0.5 * std::numbers::pi) * (added + 30.0) * float_rounding;
  const double ends = normal.z != 0.0F ? 4.0 * float_rounding / std::abs(double{normal.z}) : 0.0;
  return terms + ends + quadrature_error;
}

}  // namespace farlod
