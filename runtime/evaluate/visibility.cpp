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

}  // namespace farlod
