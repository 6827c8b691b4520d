// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

/// Sky view factors that are known in closed form. Heights are above the receiver; `cos` weighs by the cosine to the receiver's
/// normal, `solid` by solid angle.
namespace farlod::oracles {

inline constexpr double pi = std::numbers::pi;

/// An endless wall of height H at distance d.
inline double wall_cos(double H, double d) { return (1.0 + std::cos(std::atan(H / d))) / 2.0; }
inline double wall_solid(double H, double d) { return 1.0 - std::atan(H / d) / pi; }

/// An endless canyon of width W, walls H1 and H2 high, x away from the first.
inline double canyon_cos(double H1, double H2, double W, double x) {
  return (std::cos(std::atan(H1 / x)) + std::cos(std::atan(H2 / (W - x)))) / 2.0;
}
inline double canyon_solid(double H1, double H2, double W, double x) {
  return 1.0 - (std::atan(H1 / x) + std::atan(H2 / (W - x))) / pi;
}

/// Means over the floor and a wall of an endless canyon, h = H/W.
inline double canyon_floor_mean(double h) { return std::sqrt(1.0 + h * h) - h; }
inline double canyon_wall_mean(double h) { return (h + 1.0 - std::sqrt(1.0 + h * h)) / (2.0 * h); }

/// A point of a wall, q below the top of the wall opposite, W away.
inline double wall_point_cos(double q, double W) { return (1.0 - std::sin(std::atan(q / W))) / 2.0; }
inline double wall_point_solid(double q, double W) { return 0.5 - std::atan(q / W) / pi; }

/// A round court of radius R and height H, r off its middle. The solid angle has no closed form off the middle.
inline double round_court_cos(double R, double H, double r) {
  const double s = H * H + R * R + r * r;
  return 0.5 * (1.0 - (H * H + r * r - R * R) / std::sqrt(s * s - 4.0 * r * r * R * R));
}
/// A basin whose horizon stands at the elevation b all around.
inline double basin_cos(double b) { return std::cos(b) * std::cos(b); }
inline double basin_solid(double b) { return 1.0 - std::sin(b); }

/// A wall of height H at distance d that ends a1 to the one side and a2 to the other.
inline double finite_wall_cos(double H, double d, double a1, double a2) {
  const double b = std::atan(H / d);
  const auto hidden = [b](double g) { return g - std::cos(b) * std::atan(std::cos(b) * std::tan(g)); };
  return 1.0 - (hidden(std::atan(a1 / d)) + hidden(std::atan(a2 / d))) / (2.0 * pi);
}
inline double finite_wall_solid(double H, double d, double a1, double a2) {
  const double b = std::atan(H / d);
  const auto hidden = [b](double g) { return std::asin(std::sin(b) * std::sin(g)); };
  return 1.0 - (hidden(std::atan(a1 / d)) + hidden(std::atan(a2 / d))) / (2.0 * pi);
}

/// A rectangular court: the part of the sky over one quadrant, whose opening at the height H reaches a by b.
inline double court_quadrant_cos(double a, double b, double H) {
  const double A = a / H, B = b / H;
  const double p = std::sqrt(1.0 + A * A), q = std::sqrt(1.0 + B * B);
  return (A / p * std::atan(B / p) + B / q * std::atan(A / q)) / (2.0 * pi);
}
inline double court_quadrant_solid(double a, double b, double H) {
  return std::atan(a * b / (H * std::sqrt(H * H + a * a + b * b))) / (2.0 * pi);
}

/// A receiver tilted by t in the open.
inline double tilted_cos(double t) { return (1.0 + std::cos(t)) / 2.0; }
/// A half plane h overhead whose edge is e away; under it, or beside it.
inline double overhang_cos(double h, double e, bool under) {
  return (1.0 + (under ? -1.0 : 1.0) * std::sin(std::atan(e / h))) / 2.0;
}

}  // namespace farlod::oracles
