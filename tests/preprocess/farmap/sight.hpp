// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "base/azimuth.hpp"
#include "farlod/point.hpp"

namespace farlod::test {

/// Numbers that are the same in every run.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  [[nodiscard]] double between(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }
  [[nodiscard]] std::size_t below(std::size_t n) { return engine_() % n; }

 private:
  std::mt19937_64 engine_;
};

/// How steeply the ray from an eye at an azimuth rises to an edge; none where it passes beside it. By intersecting the two lines
/// in the plane, which shares nothing with the formulas that are tested with it.
[[nodiscard]] inline std::optional<double> slope_at(double azimuth_rad, const Point3d& a, const Point3d& b, const Point3d& eye) {
  const Point2d u{std::cos(azimuth_rad), std::sin(azimuth_rad)}, along = horizontal(b) - horizontal(a),
                                                                 to_a = horizontal(a) - horizontal(eye);
  const double determinant = u.x * along.y - u.y * along.x;
  const double distance_m = (to_a.x * along.y - to_a.y * along.x) / determinant;
  const double share = (to_a.x * u.y - to_a.y * u.x) / determinant;
  if (!(distance_m > 0.0 && share >= 0.0 && share <= 1.0)) return std::nullopt;
  return (a.z + share * (b.z - a.z) - eye.z) / distance_m;
}

/// A point as seen from an eye.
struct Sight {
  std::uint32_t bin = 0;
  double slope = 0.0;
};
[[nodiscard]] inline Sight sight_of(const Point3d& p, const Point3d& eye, const AzimuthBins& bins) {
  const Point2d d = horizontal(p) - horizontal(eye);
  return {bins.bin_of(d), (p.z - eye.z) / norm(d)};
}

[[nodiscard]] inline Point3d point_between(const Point3d& a, const Point3d& b, double share) { return a + share * (b - a); }

}  // namespace farlod::test
