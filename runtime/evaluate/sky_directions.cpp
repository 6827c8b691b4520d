// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_directions.hpp"

#include <cmath>
#include <numbers>

#include "base/cancellation.hpp"

namespace farlod {

namespace {

/// n points on the disk or the hemisphere, each with the same share of the sky around it: ring by ring by the golden angle.
std::vector<Point3d> fibonacci_directions(SkyWeight weight, std::size_t n, const std::stop_token& stop) {
  constexpr double golden_turns = 2.0 - std::numbers::phi;
  std::vector<Point3d> result;
  for (std::size_t i = 0; i < n; ++i) {
    throw_if_cancelled(stop);
    const double turns = static_cast<double>(i) * golden_turns;
    const double share_above = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    result.push_back(sky_direction(weight, share_above, 2.0 * std::numbers::pi * (turns - std::floor(turns))));
  }
  return result;
}

}  // namespace

SkyDirections::SkyDirections(SkyWeight weight, std::size_t ray_count, const GridRotation& rotation, DirectionSet set,
                             const std::stop_token& stop)
    : local_(set == DirectionSet::partition ? SkyPartition(weight, ray_count).directions(stop)
                                            : fibonacci_directions(weight, ray_count, stop)) {
  facing_up_.reserve(local_.size());
  for (const Point3d& d : local_) facing_up_.push_back(rotation.grid_from_city(d));
}

std::vector<Point3d> SkyDirections::facing(const Point3d& normal) const {
  // The receiver's own axes: one along the contour line, one up the slope
  const Point3d contour = normalized(cross(Point3d{0.0, 0.0, 1.0}, normal));
  if (contour == Point3d{}) return normal.z > 0.0 ? facing_up_ : std::vector<Point3d>{};
  const Point3d upslope = cross(normal, contour);
  std::vector<Point3d> result;
  for (const Point3d& d : local_) {
    const Point3d direction = d.x * contour + d.y * upslope + d.z * normal;
    if (direction.z > 0.0) result.push_back(direction);
  }
  return result;
}

}  // namespace farlod
