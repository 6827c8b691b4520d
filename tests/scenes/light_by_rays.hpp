// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/grid.hpp"
#include "farlod/light.hpp"
#include "farlod/point.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/occluder.hpp"

namespace farlod::scenes {

/// The light of a period by brute force, the judge of one distribution for all of its hours: each position of the sun is a ray,
/// and the sky of each interval is summed up over spherical Fibonacci directions.
class LightByRays {
 public:
  using Months = std::array<double, 12>;  ///< kWh/m²

  /// `convergence` is that of the grid's city at its middle: true azimuth = azimuth in the city + convergence.
  LightByRays(const Light& light, std::size_t directions, const GridRotation& rotation, Angle convergence = {});

  /// What falls on a receiver of the scene's frame from the sun and from the sky; nothing is reflected. `crowns` may be null.
  [[nodiscard]] Months on(const Point3f& origin, const Point3d& normal, const Occluder& city,
                          const CrownOccluder* crowns = nullptr) const;

 private:
  struct Ray {
    Point3d direction_grid;
    Months of_month;  ///< on a plane that faces it
  };
  void add_sky(const Light& light, std::size_t directions, const GridRotation& rotation, Angle convergence);
  void add_sun(const Light& light, const GridRotation& rotation, Angle convergence);

  std::vector<Ray> rays_;
};

[[nodiscard]] double year_of(const LightByRays::Months& months);

}  // namespace farlod::scenes
