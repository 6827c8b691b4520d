// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "farlod/point.hpp"

namespace farlod {

/// Horizontal distance from the origin to the segment between two points.
[[nodiscard]] inline double distance_to_segment(Point2d a, Point2d b) {
  const Point2d along = b - a;
  const double squared = dot(along, along);
  const double s = squared > 0.0 ? std::clamp(-dot(a, along) / squared, 0.0, 1.0) : 0.0;
  const Point2d nearest = a + s * along;
  return std::sqrt(dot(nearest, nearest));
}

}  // namespace farlod
