// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/facing.hpp"

#include <algorithm>
#include <cmath>

namespace farlod {

Facing facing_of(const Point3d& normal_grid, const package::Manifest& manifest) {
  const Angle tilt = Angle::radians(std::acos(std::clamp(normal_grid.z, -1.0, 1.0)));
  const Point2d n_city = manifest.grid.rotation.city_from_grid(horizontal(normal_grid));
  if (n_city == Point2d{}) return {{}, tilt};
  const double azimuth_deg = azimuth_of(n_city).degrees() + manifest.convergence.degrees();
  return {Angle::degrees(azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0)), tilt};
}

Point3d normal_of(const Facing& facing, const package::Manifest& manifest) {
  const Angle grid_azimuth = facing.azimuth - manifest.convergence;
  const Point2d n_city = sin(facing.tilt) * Point2d{sin(grid_azimuth), cos(grid_azimuth)};
  const Point2d n_grid = manifest.grid.rotation.grid_from_city(n_city);
  return {n_grid.x, n_grid.y, cos(facing.tilt)};
}

}  // namespace farlod
