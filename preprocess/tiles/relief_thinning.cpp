// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/relief_thinning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>

namespace farlod::tiles {
namespace {

/// A square: the number of doublings of its side, its column and its row.
using Square = std::tuple<int, std::int64_t, std::int64_t>;

/// The larger of the distances along x and y; 0 inside the rectangle.
double distance_from(const Box2d& rectangle, const Point3d& p) {
  return std::max({rectangle.low.x - p.x, p.x - rectangle.high.x, rectangle.low.y - p.y, p.y - rectangle.high.y, 0.0});
}

Square square_of(const Point3d& p, double distance_m, double side_m) {
  const int doublings = std::ilogb(distance_m / side_m);
  const double edge_m = 0.25 * std::ldexp(side_m, doublings);
  return {doublings, static_cast<std::int64_t>(std::floor(p.x / edge_m)), static_cast<std::int64_t>(std::floor(p.y / edge_m))};
}

}  // namespace

std::vector<Point3d> thinned_relief(std::vector<Point3d> points, const Box2d& rectangle) {
  const double side_m = std::max(rectangle.high.x - rectangle.low.x, rectangle.high.y - rectangle.low.y);
  std::sort(points.begin(), points.end(),
            [](const Point3d& a, const Point3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  std::set<Square> taken;
  std::erase_if(points, [&](const Point3d& p) {
    const double distance_m = distance_from(rectangle, p);
    return distance_m > side_m && !taken.insert(square_of(p, distance_m, side_m)).second;
  });
  return points;
}

}  // namespace farlod::tiles
