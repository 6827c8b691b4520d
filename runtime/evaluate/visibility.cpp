// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/visibility.hpp"

#include <algorithm>

#include "base/cancellation.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

RayOrigins gathered(std::span<const Point3f> origins) {
  RayOrigins result;
  for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
    const Point3f& p = origins[std::min(l, origins.size() - 1)];
    result.x[l] = p.x;
    result.y[l] = p.y;
    result.z[l] = p.z;
  }
  return result;
}

std::vector<std::uint32_t> count_free(const Occluder& occluder, std::span<const Point3f> origins,
                                      std::span<const Point3d> directions, const std::stop_token& stop) {
  std::vector<std::uint32_t> free(origins.size(), 0);
  for (std::size_t first = 0; first < origins.size(); first += RayOrigins::lanes) {
    const std::size_t count = std::min(RayOrigins::lanes, origins.size() - first);
    const RayOrigins together = gathered(origins.subspan(first, count));
    const std::uint32_t wanted = (1U << count) - 1;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (k % directions_between_looks == 0) throw_if_cancelled(stop);
      const std::uint32_t open = wanted & ~occluder.blocked(together, rounded(directions[k]), least_distance_m, wanted);
      for (std::size_t l = 0; l < count; ++l) free[first + l] += (open >> l) & 1U;
    }
  }
  return free;
}

bool RayScene::blocks(const Point3f& p_cell, const Point3f& direction) const {
  return is_far_blocked({direction.x, direction.y, direction.z}) ||
         solid.occluder.blocks({placed(p_cell, solid.scene_from_cell_m), direction, least_distance_m});
}

std::uint32_t RayScene::blocked(const RayOrigins& origins, const Occluder::Directions& directions, std::uint32_t wanted) const {
  std::uint32_t by_far = 0;
  for (std::size_t l = 0; l < RayOrigins::lanes && far != nullptr; ++l)
    by_far |= far->blocks({directions.x[l], directions.y[l], directions.z[l]}) ? 1U << l : 0U;
  return by_far | solid.occluder.blocked(origins, directions, least_distance_m, wanted);
}

}  // namespace farlod
