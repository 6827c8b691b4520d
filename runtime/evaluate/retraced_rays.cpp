// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/retraced_rays.hpp"

#include <algorithm>

#include "occlusion/placed_mesh.hpp"

namespace farlod {

std::uint64_t retrace_open_rays(double most, std::span<const Receiver> receivers, const RayEngine& engine,
                                const std::function<PlacedScene()>& whole_city, std::span<FreeRays> free) {
  std::uint32_t uncertain = 0;
  for (std::size_t l = 0; l < free.size(); ++l)
    if (std::max(free[l].high - free[l].estimate, free[l].estimate - free[l].low) > most) uncertain |= 1U << l;
  if (uncertain == 0) return 0;
  const PlacedScene city = whole_city();
  RayOrigins origins;
  for (std::size_t l = 0; l < receivers.size(); ++l) {
    const Point3f p = placed(receivers[l].p_cell, city.scene_from_cell_m);
    origins.x[l] = p.x;
    origins.y[l] = p.y;
    origins.z[l] = p.z;
  }
  return engine.retrace(city.occluder, origins, uncertain, free);
}

}  // namespace farlod
