// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod::far_terrain {

/// A half-plane: what is beyond its line has a positive offset.
struct HalfPlane {
  Point2d outward;
  double offset_m = 0.0;
  [[nodiscard]] double beyond_m(const Point3d& p) const { return dot(outward, horizontal(p)) - offset_m; }
};

/// The same bits whichever way the side runs, so that triangles beside each other still meet.
[[nodiscard]] inline Point3d crossing_of(const HalfPlane& border, Point3d a, Point3d b) {
  if (std::tie(b.x, b.y) < std::tie(a.x, a.y)) std::swap(a, b);
  const double da = border.beyond_m(a), db = border.beyond_m(b);
  return a + da / (da - db) * (b - a);
}

/// Divides a convex polygon into what lies within the half-plane, and what lies beyond.
[[nodiscard]] inline std::pair<std::vector<Point3d>, std::vector<Point3d>> divided(const std::vector<Point3d>& polygon,
                                                                                   const HalfPlane& border) {
  std::pair<std::vector<Point3d>, std::vector<Point3d>> parts;
  auto& [within, beyond] = parts;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Point3d &p = polygon[n], &next = polygon[(n + 1) % polygon.size()];
    const double d = border.beyond_m(p), d_next = border.beyond_m(next);
    if (d <= 0.0) within.push_back(p);
    if (d >= 0.0) beyond.push_back(p);
    if (d * d_next >= 0.0) continue;
    within.push_back(crossing_of(border, p, next));
    beyond.push_back(within.back());
  }
  return parts;
}

/// The parts of a triangle that lie, in the plan, outside of a rectangle.
[[nodiscard]] inline std::vector<std::array<Point3d, 3>> outside_of(const Box2d& rectangle,
                                                                    const std::array<Point3d, 3>& triangle) {
  Box2d outline;
  for (const Point3d& p : triangle) outline.add(horizontal(p));
  const auto& [low, high] = rectangle;
  if (outline.high.x <= low.x || outline.low.x >= high.x || outline.high.y <= low.y || outline.low.y >= high.y) return {triangle};
  std::vector<std::array<Point3d, 3>> parts;
  std::vector<Point3d> rest(triangle.begin(), triangle.end());
  for (const HalfPlane& border : {HalfPlane{{-1.0, 0.0}, -low.x}, HalfPlane{{1.0, 0.0}, high.x}, HalfPlane{{0.0, -1.0}, -low.y},
                                  HalfPlane{{0.0, 1.0}, high.y}}) {
    auto [within, beyond] = divided(rest, border);
    for (std::size_t n = 2; n < beyond.size(); ++n) parts.push_back({beyond[0], beyond[n - 1], beyond[n]});
    rest = std::move(within);
  }
  return parts;
}

}  // namespace farlod::far_terrain
