// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "farlod/angle.hpp"
#include "farlod/point.hpp"

namespace farlod {

// The frames, outermost first. All are right-handed, metric, z up.
//   projected  the output CRS: easting and northing as a map gives them, heights as the source gives them
//   city       projected minus an origin kept in double, so that coordinates are small
//   grid       city turned about that origin, so that y runs along the dominant streets
//   cell       grid minus the south-west corner of a cell, heights minus the package's height origin; float on disk

/// Turns the city frame into the grid frame and back.
/// `bearing` is the direction of the grid's y axis, clockwise from the city's y axis (grid north).
class GridRotation {
 public:
  GridRotation() = default;
  explicit GridRotation(Angle bearing)
      : bearing_(bearing), cos_(std::cos(bearing.radians())), sin_(std::sin(bearing.radians())) {}

  [[nodiscard]] Angle bearing() const { return bearing_; }
  [[nodiscard]] Point2d grid_from_city(Point2d p_city) const {
    return {cos_ * p_city.x - sin_ * p_city.y, sin_ * p_city.x + cos_ * p_city.y};
  }
  [[nodiscard]] Point2d city_from_grid(Point2d p_grid) const {
    return {cos_ * p_grid.x + sin_ * p_grid.y, -sin_ * p_grid.x + cos_ * p_grid.y};
  }
  [[nodiscard]] Point3d grid_from_city(const Point3d& p_city) const {
    const Point2d p = grid_from_city(horizontal(p_city));
    return {p.x, p.y, p_city.z};
  }
  [[nodiscard]] Point3d city_from_grid(const Point3d& p_grid) const {
    const Point2d p = city_from_grid(horizontal(p_grid));
    return {p.x, p.y, p_grid.z};
  }

 private:
  Angle bearing_;
  double cos_ = 1.0, sin_ = 0.0;
};

/// Azimuth of a horizontal vector: clockwise from the frame's y axis, in [0, 2π).
[[nodiscard]] inline Angle azimuth_of(Point2d v) {
  const double a = std::atan2(v.x, v.y);
  // A hair west of north, the sum rounds to the whole turn
  const double turned = a < 0.0 ? a + 2.0 * std::numbers::pi : a;
  return Angle::radians(turned < 2.0 * std::numbers::pi ? turned : 0.0);
}

}  // namespace farlod
