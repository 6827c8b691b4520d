// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>

#include "farlod/point.hpp"

namespace farlod {

// What triangles do in the plan. PlanIndex and LatticeCrossings ask the same functions, so that both give the same bits.

using PlanTriangle = std::array<Point3f, 3>;

/// A triangle over a place, by its number among those that were given, and its height there.
struct PlanCrossing {
  std::uint32_t triangle = 0;
  float height_m = 0.0F;
  bool operator==(const PlanCrossing&) const = default;
};

/// The rectangle around a triangle.
struct PlanOutline {
  float west, east, south, north;

  [[nodiscard]] bool contains(float x, float y) const { return west <= x && x <= east && south <= y && y <= north; }
};

[[nodiscard]] inline PlanOutline outline_of(const PlanTriangle& t) {
  return {std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y}),
          std::max({t[0].y, t[1].y, t[2].y})};
}

/// Which side of the line from a to b a place is on: left is positive. The ends are taken in one order, whichever way the edge
/// runs, so that both triangles beside it say the same.
[[nodiscard]] inline double side_of(const Point3f& a, const Point3f& b, float x, float y) {
  const bool turned = std::tie(b.x, b.y) < std::tie(a.x, a.y);
  const Point3f &from = turned ? b : a, &to = turned ? a : b;
  const double side = (double{to.x} - from.x) * (double{y} - from.y) - (double{to.y} - from.y) * (double{x} - from.x);
  return turned ? -side : side;
}

/// Twice the area in the plan; negative where the corners run clockwise.
[[nodiscard]] inline double plan_area(const PlanTriangle& t) { return side_of(t[0], t[1], t[2].x, t[2].y); }

/// Whether a triangle lies over a place. Along the line of a sliver, rounding alone would say so beyond its ends, too.
[[nodiscard]] inline bool covers(const PlanTriangle& t, float x, float y) {
  if (!outline_of(t).contains(x, y)) return false;
  const double ab = side_of(t[0], t[1], x, y), bc = side_of(t[1], t[2], x, y), ca = side_of(t[2], t[0], x, y);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// The height of a triangle that covers a place.
[[nodiscard]] inline float height_at(const PlanTriangle& t, float x, float y) {
  const double ux = double{t[1].x} - t[0].x, uy = double{t[1].y} - t[0].y, uz = double{t[1].z} - t[0].z;
  const double vx = double{t[2].x} - t[0].x, vy = double{t[2].y} - t[0].y, vz = double{t[2].z} - t[0].z;
  const double px = double{x} - t[0].x, py = double{y} - t[0].y, area = ux * vy - uy * vx;
  const double z = (uz * (px * vy - py * vx) + vz * (ux * py - uy * px)) / area;
  // Beyond its corners no triangle is higher, whatever rounding says
  const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
  return std::clamp(static_cast<float>(t[0].z + z), low, high);
}

}  // namespace farlod
