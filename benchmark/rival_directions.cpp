// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/rival_directions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmark/plane_curve.hpp"

namespace farlod::benchmark {

std::vector<Point3d> fibonacci_directions(std::size_t count) {
  constexpr double golden_turn = 2.0 - std::numbers::phi;
  std::vector<Point3d> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double azimuth = 2.0 * std::numbers::pi * golden_turn * static_cast<double>(i), r = std::sqrt(u);
    directions.push_back({r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1.0 - u)});
  }
  return directions;
}

void put_in_order(DirectionOrder order, std::vector<Point3d>& directions) {
  if (order == DirectionOrder::as_given) return;
  const auto place = [](const Point3d& d) { return place_on_curve(0.5 * (d.x + 1.0), 0.5 * (d.y + 1.0)); };
  std::stable_sort(directions.begin(), directions.end(), [&](const Point3d& a, const Point3d& b) { return place(a) < place(b); });
}

std::vector<Point3f> directions_around(std::span<const Point3d> local, const Point3f& normal) {
  const Point3d n = normalized(Point3d{normal.x, normal.y, normal.z});
  // One axis along the contour line of the surface, one up its slope
  Point3d contour = normalized(cross(Point3d{0.0, 0.0, 1.0}, n));
  if (contour == Point3d{}) contour = {n.z, 0.0, 0.0};
  const Point3d upslope = cross(n, contour);
  std::vector<Point3f> result;
  for (const Point3d& d : local) {
    const Point3d direction = d.x * contour + d.y * upslope + d.z * n;
    if (direction.z > 0.0)
      result.push_back({static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(direction.z)});
  }
  return result;
}

}  // namespace farlod::benchmark
