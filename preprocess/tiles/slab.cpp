// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/slab.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "city/geometry.hpp"

namespace farlod::tiles {

double Slab::height_m(Point2d p) const {
  const Point3d n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  return corners[0].z - (n.x * (p.x - corners[0].x) + n.y * (p.y - corners[0].y)) / n.z;
}

std::optional<Slab> slab_of(const std::array<Point3d, 3>& t, FacetLook look) {
  // The plan of a thinner triangle has no inside
  constexpr double least_plan_m2 = 1e-6;
  const Point3d normal = cross(t[1] - t[0], t[2] - t[0]);
  if (!(std::abs(normal.z) > least_plan_m2)) return std::nullopt;
  const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
  const double lean = std::abs(normal.z) / norm(normal);
  if (lean <= leaning_wall_z && lean * (high - low) <= max_lean_m) return std::nullopt;
  return Slab{t, look};
}

std::optional<ShareStretch> part_within(const Slab& slab, Point2d from, Point2d to) {
  const auto& [a, b, c] = slab.corners;
  const double turn = std::copysign(1.0, across(horizontal(b - a), horizontal(c - a)));
  ShareStretch inside;
  for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
    // The distance from a side is linear along the way: keep where it is not negative
    const Point2d side = turn * horizontal(q - p);
    const double at_from = across(side, from - horizontal(p)), at_to = across(side, to - horizontal(p));
    if (at_from < 0.0 && at_to < 0.0) return std::nullopt;
    if (at_from < 0.0) inside.from = std::max(inside.from, at_from / (at_from - at_to));
    if (at_to < 0.0) inside.to = std::min(inside.to, at_from / (at_from - at_to));
  }
  if (!(inside.to > inside.from)) return std::nullopt;
  return inside;
}

}  // namespace farlod::tiles
