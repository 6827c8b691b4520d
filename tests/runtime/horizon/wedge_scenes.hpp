// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/picture_plane.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"

// Scenes whose sky is known in closed form, or by quadrature: for what computes the sky wedge by wedge.

namespace farlod {

using Triangle3d = std::array<Point3d, 3>;

inline constexpr double turn_rad = 2.0 * std::numbers::pi;

/// So many equal wedges, from an azimuth that is no axis of any scene.
[[nodiscard]] inline std::vector<Wedge> wedges_of_turn(std::size_t count) {
  std::vector<Wedge> wedges;
  const double width = turn_rad / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double azimuth = 0.1 + width * static_cast<double>(k);
    wedges.push_back({{std::cos(azimuth), std::sin(azimuth)}, std::tan(width)});
  }
  return wedges;
}

/// A plane quadrilateral, corner by corner.
[[nodiscard]] inline std::vector<Triangle3d> quadrilateral(const Point3d& a, const Point3d& b, const Point3d& c,
                                                           const Point3d& d) {
  return {{a, b, c}, {a, c, d}};
}
[[nodiscard]] inline std::vector<Triangle3d> joined(std::span<const std::vector<Triangle3d>> parts) {
  std::vector<Triangle3d> all;
  for (const std::vector<Triangle3d>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The share of a receiver's sky that a polygon hides which lies in front of it and above the level: Lambert's formula. Its
/// corners come counterclockwise as the receiver sees them.
[[nodiscard]] inline double view_factor(std::span<const Point3d> corners, const Point3d& normal) {
  double sum = 0.0;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Point3d &p = corners[n], &q = corners[(n + 1) % corners.size()], across = cross(p, q);
    sum += std::atan2(norm(across), dot(p, q)) * dot(normalized(across), normal);
  }
  return sum / turn_rad;
}

/// A level rectangle with a corner straight overhead, a by b, at the height h, by a level receiver: view factor, and solid angle.
[[nodiscard]] inline double overhead_view_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, u = std::sqrt(1.0 + x * x), v = std::sqrt(1.0 + y * y);
  return (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / turn_rad;
}
[[nodiscard]] inline double overhead_solid_angle(double a, double b, double h) {
  return std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h)));
}

/// An upright rectangle with a corner at the distance d on the level, b wide and h high, by a level receiver.
[[nodiscard]] inline double wall_view_factor(double d, double b, double h) {
  const double top = std::hypot(d, h);
  return (std::atan(b / d) - d / top * std::atan(b / top)) / turn_rad;
}

/// The slopes that triangles hide at an azimuth, as intervals.
class HiddenSlopes {
 public:
  explicit HiddenSlopes(std::span<const Triangle3d> triangles) : triangles_(triangles) {}

  /// F at the azimuth of a unit vector.
  [[nodiscard]] double sky(Point2d u, const Point3d& normal, SkyWeight weight) const {
    std::vector<SlopeRange> hidden;
    for (const Triangle3d& triangle : triangles_) add(triangle, u, hidden);
    std::sort(hidden.begin(), hidden.end(), [](const SlopeRange& a, const SlopeRange& b) { return a.low < b.low; });
    const double outward = normal.x * u.x + normal.y * u.y;
    const auto above = [&](double slope) { return sky_above_slope(outward, normal.z, slope, weight); };
    double reached = 0.0, sky = 0.0;
    for (const SlopeRange& range : hidden) {
      if (range.low > reached) sky += above(reached) - above(range.low);
      reached = std::max(reached, range.high);
    }
    return sky + above(reached);
  }

 private:
  /// "Above a horizon", between the slopes that are in front of the receiver.
  static double sky_above_slope(double outward, double upward, double slope, SkyWeight weight) {
    if (outward <= 0.0 && upward <= 0.0) return 0.0;
    const auto above = [&](double t) {
      if (std::isinf(t)) return 0.0;
      if (weight == SkyWeight::solid_angle) return 1.0 - t / std::sqrt(1.0 + t * t);
      return outward * (0.5 * std::numbers::pi - std::atan(t) - t / (1.0 + t * t)) + upward / (1.0 + t * t);
    };
    if (upward < 0.0) return above(std::min(slope, -outward / upward)) - above(-outward / upward);
    return above(outward < 0.0 ? std::max(slope, -outward / upward) : slope);
  }

  static void add(const Triangle3d& triangle, Point2d u, std::vector<SlopeRange>& hidden) {
    // Where edges meet the upright plane: distance along the azimuth, and height
    std::vector<Point2d> met;
    const auto aside = [&](const Point3d& p) { return p.y * u.x - p.x * u.y; };
    for (std::size_t n = 0; n < 3; ++n) {
      const Point3d &p = triangle[n], &q = triangle[(n + 1) % 3];
      if ((aside(p) < 0.0) == (aside(q) < 0.0)) continue;
      const Point3d at = p + (aside(p) / (aside(p) - aside(q))) * (q - p);
      met.push_back({at.x * u.x + at.y * u.y, at.z});
    }
    if (met.size() != 2 || (met[0].x <= 0.0 && met[1].x <= 0.0)) return;
    if (met[0].x > met[1].x) std::swap(met[0], met[1]);
    const double far_slope = met[1].y / met[1].x;
    double near_slope = met[0].y / met[0].x;
    if (met[0].x <= 0.0) {
      const double overhead = met[0].y + (met[1].y - met[0].y) * (met[0].x / (met[0].x - met[1].x));
      near_slope = std::copysign(std::numeric_limits<double>::infinity(), overhead);
    }
    hidden.push_back({std::min(near_slope, far_slope), std::max(near_slope, far_slope)});
  }

  std::span<const Triangle3d> triangles_;
};

struct Quadrature {
  double sky = 0.0, error = 0.0;
};

/// The sky of a wedge from so many azimuths, each in the middle of its part. Where F varies by V_i within a part, the middle is
/// at most V_i/2 off the mean. V is taken from the samples, twice, and of a part where F has an extremum it sees the sides only:
/// it is smooth there, and the error is of the second order.
[[nodiscard]] inline Quadrature sky_by_quadrature(std::span<const Triangle3d> triangles, const Wedge& wedge,
                                                  const Point3d& normal, SkyWeight weight, std::size_t azimuths) {
  const HiddenSlopes hidden(triangles);
  const double width = std::atan(wedge.tangent), step = width / static_cast<double>(azimuths);
  const double first = std::atan2(wedge.from.y, wedge.from.x);
  double sum = 0.0, variation = 0.0, before = 0.0;
  for (std::size_t n = 0; n < azimuths; ++n) {
    const double azimuth = first + step * (static_cast<double>(n) + 0.5);
    const double sky = hidden.sky({std::cos(azimuth), std::sin(azimuth)}, normal, weight);
    if (n > 0) variation += std::abs(sky - before);
    sum += sky;
    before = sky;
  }
  return {sum * step, variation * step + 1e-9 * width};
}

}  // namespace farlod
