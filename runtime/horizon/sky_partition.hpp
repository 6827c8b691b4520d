// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stop_token>
#include <vector>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The Beckers & Beckers equal-area partition of the sky (Comput. Geom. 45 (2012) 275–283): rings around the zenith,
/// the cells of a ring having equal azimuth.
///   (1) all cells have the same weight, 1/size()
///   (2) the ring boundaries are where u = k_i/k, with u = sin²θ (cosine) or 1 − cos θ (solid angle), θ from the zenith
///   (3) k_1 = 1: the zenith is one cell
class SkyPartition {
 public:
  SkyPartition(SkyWeight weight, std::size_t cell_count) : weight_(weight), cells_inside_(rings(weight, cell_count)) {}

  [[nodiscard]] SkyWeight weight() const { return weight_; }
  [[nodiscard]] std::size_t size() const { return cells_inside_.back(); }
  /// k_i: how many cells lie inside the i-th circle, from the zenith outwards; the last is size().
  [[nodiscard]] const std::vector<std::size_t>& cells_inside() const { return cells_inside_; }
  [[nodiscard]] std::size_t ring_count() const { return cells_inside_.size(); }
  [[nodiscard]] std::size_t cells_of_ring(std::size_t ring) const {
    return ring == 0 ? cells_inside_[0] : cells_inside_[ring] - cells_inside_[ring - 1];
  }

  /// One direction of length 1 in each cell, ring by ring from the zenith; z is the axis of the hemisphere.
  ///
  /// Within a ring, the m-th of n samples has azimuth (m + ½)/n of the circle, and the share frac(m/golden ratio) of the
  /// ring's area below it: a lattice, so that a horizon at constant height is not counted a whole ring at once.
  /// Rings are turned against each other by the golden angle: rings that all start at azimuth 0 alias with streets.
  /// Throws Cancelled when `stop` is asked for.
  [[nodiscard]] std::vector<Point3d> directions(const std::stop_token& stop = {}) const;

 private:
  [[nodiscard]] static std::vector<std::size_t> rings(SkyWeight weight, std::size_t cell_count);
  [[nodiscard]] static std::size_t next_ring_inside(SkyWeight weight, std::size_t inside, std::size_t all);

  SkyWeight weight_;
  std::vector<std::size_t> cells_inside_;
};

/// The direction at zenith distance θ, where u = sin²θ (cosine) or 1 − cos θ (solid angle); azimuth clockwise from y.
[[nodiscard]] inline Point3d sky_direction(SkyWeight weight, double u, double azimuth_rad) {
  const double cos_zenith = weight == SkyWeight::cosine ? std::sqrt(1.0 - u) : 1.0 - u;
  const double sin_zenith = weight == SkyWeight::cosine ? std::sqrt(u) : std::sqrt(u * (2.0 - u));
  return {sin_zenith * std::sin(azimuth_rad), sin_zenith * std::cos(azimuth_rad), cos_zenith};
}

/// The inverse: u of a direction of length 1.
[[nodiscard]] inline double sky_share_above(SkyWeight weight, const Point3d& direction) {
  return weight == SkyWeight::cosine ? direction.x * direction.x + direction.y * direction.y : 1.0 - direction.z;
}

inline std::size_t SkyPartition::next_ring_inside(SkyWeight weight, std::size_t inside, std::size_t all) {
  const auto k_i = static_cast<double>(inside), k = static_cast<double>(all);
  double shrink = 0.0;  // r_{i−1} / r_i, with the aspect ratio a = 1
  if (weight == SkyWeight::cosine) {
    const double r = std::sqrt(k_i / k);
    shrink = (r - std::sqrt(std::numbers::pi / k)) / r;
  } else {
    const double zenith = std::acos(1.0 - k_i / k);
    const double r = 2.0 * std::sin(zenith / 2.0);                              // (16)
    const double next_zenith = zenith - r * std::sqrt(std::numbers::pi / k_i);  // (20)
    shrink = 2.0 * std::sin(next_zenith / 2.0) / r;
  }
  const double next = shrink > 0.0 ? std::floor(k_i * shrink * shrink + 0.5) : 0.0;  // (1)
  const double smallest_ring = weight == SkyWeight::cosine ? 6.0 : 7.0;
  return next < smallest_ring ? 1 : static_cast<std::size_t>(next);
}

inline std::vector<std::size_t> SkyPartition::rings(SkyWeight weight, std::size_t cell_count) {
  FARLOD_EXPECTS(cell_count >= 1);
  std::vector<std::size_t> outside_in{cell_count};
  while (outside_in.back() > 1) outside_in.push_back(next_ring_inside(weight, outside_in.back(), cell_count));
  std::reverse(outside_in.begin(), outside_in.end());
  return outside_in;
}

inline std::vector<Point3d> SkyPartition::directions(const std::stop_token& stop) const {
  constexpr double golden = std::numbers::phi - 1.0;  // frac(m·golden) fills [0, 1) evenly for any number of m
  const auto fraction = [](double x) { return x - std::floor(x); };
  const auto k = static_cast<double>(size());
  std::vector<Point3d> result;
  result.reserve(size());
  for (std::size_t ring = 0; ring < ring_count(); ++ring) {
    const auto n = static_cast<double>(cells_of_ring(ring));
    const double first = static_cast<double>(cells_inside_[ring]) - n;
    throw_if_cancelled(stop);
    const double turn = fraction(static_cast<double>(ring) * golden);
    for (std::size_t m = 0; m < cells_of_ring(ring); ++m) {
      // The offset ½ makes the one cell at the zenith sample its middle
      const double share = fraction(0.5 + static_cast<double>(m) * golden);
      const double azimuth_turns = (static_cast<double>(m) + 0.5) / n + turn;
      result.push_back(sky_direction(weight_, (first + share * n) / k, 2.0 * std::numbers::pi * azimuth_turns));
    }
  }
  return result;
}

}  // namespace farlod
