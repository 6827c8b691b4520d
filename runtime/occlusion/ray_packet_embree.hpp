// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "occlusion/occluder.hpp"
#include "occlusion/queries_embree.hpp"

namespace farlod {

/// Sixteen rays as Embree takes them. Each has its lane as number: where the processor has no vectors of sixteen numbers, Embree
/// shows them one by one, and does not look at `valid`. So those that are not wanted end before they begin, too.
struct RayPacket {
  static_assert(RayOrigins::lanes == 16);

  RayPacket(const RayOrigins& origins, const Occluder::Directions& directions, float begin, std::uint32_t wanted) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t lane = 0; lane < RayOrigins::lanes; ++lane) {
      const bool is_wanted = ((wanted >> lane) & 1U) != 0;
      valid[lane] = is_wanted ? -1 : 0;
      rays.org_x[lane] = origins.x[lane];
      rays.org_y[lane] = origins.y[lane];
      rays.org_z[lane] = origins.z[lane];
      rays.dir_x[lane] = directions.x[lane];
      rays.dir_y[lane] = directions.y[lane];
      rays.dir_z[lane] = directions.z[lane];
      rays.tnear[lane] = begin;
      rays.tfar[lane] = is_wanted ? infinity : -infinity;
      rays.time[lane] = 0.0F;
      rays.mask[lane] = ~0U;
      rays.id[lane] = static_cast<unsigned>(lane);
      rays.flags[lane] = 0;
    }
  }

  alignas(64) std::array<int, RayOrigins::lanes> valid;
  RTCRay16 rays;
};

/// The same direction in each lane.
inline Occluder::Directions sixteen_times(const Point3f& direction) {
  Occluder::Directions alike;
  alike.x.fill(direction.x);
  alike.y.fill(direction.y);
  alike.z.fill(direction.z);
  return alike;
}

}  // namespace farlod
