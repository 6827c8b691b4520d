// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_directions.hpp"

namespace farlod {

SkyDirections::SkyDirections(SkyWeight weight, std::size_t ray_count, const GridRotation& rotation)
    : local_(SkyPartition(weight, ray_count).directions()) {
  horizontal_.reserve(local_.size());
  for (const Point3d& d : local_) horizontal_.push_back(rotation.grid_from_city(d));
}

std::vector<Point3d> SkyDirections::around(const Point3d& normal) const {
  // The receiver's own axes: one along the contour line, one up the slope
  const Point3d contour = normalized(cross(Point3d{0.0, 0.0, 1.0}, normal));
  if (contour == Point3d{}) return normal.z > 0.0 ? horizontal_ : std::vector<Point3d>{};
  const Point3d upslope = cross(normal, contour);
  std::vector<Point3d> result;
  for (const Point3d& d : local_) {
    const Point3d direction = d.x * contour + d.y * upslope + d.z * normal;
    if (direction.z > 0.0) result.push_back(direction);
  }
  return result;
}

}  // namespace farlod
