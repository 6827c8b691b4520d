// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/horizon_distances.hpp"

#include <algorithm>
#include <limits>

#include "farlod/angle.hpp"
#include "receivers/receiver.hpp"

namespace farlod {
namespace {

/// How far below the horizon a ray looks. The first is more than a horizon of rays is off; the others are for far maps, whose
/// horizon may lie above the true one.
constexpr double degrees_below[] = {0.02, 0.1, 0.5, 2.0};

/// The length of a direction's level part is 1: so distances along it are level ones.
float distance_below(const Occluder& city, const Point3f& origin, const Point2d& direction, double elevation_deg) {
  for (const double below_deg : degrees_below) {
    const double slope = tan(Angle::degrees(std::max(0.0, elevation_deg - below_deg)));
    const Point3f towards{static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(slope)};
    if (const auto hit = city.nearest({origin, towards, least_distance_m})) return hit->distance;
  }
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

void trace_horizon_distances(const Occluder& city, const Point3f& origin, const HorizonColumns& columns,
                             std::span<float> values) {
  for (std::size_t n = 0; n < columns.directions_grid.size(); ++n) {
    const double elevation_deg = static_cast<double>(values[columns.elevations + n]);
    values[columns.distances + n] = elevation_deg > 0.0 ? distance_below(city, origin, columns.directions_grid[n], elevation_deg)
                                                        : std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace farlod
