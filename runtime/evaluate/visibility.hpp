// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"
#include "occlusion/occluder.hpp"
#include "occlusion/placed_mesh.hpp"
#include "package/far_map_reader.hpp"

namespace farlod {

/// At most `RayOrigins::lanes` places, one at least; lanes without one repeat the last.
[[nodiscard]] RayOrigins gathered(std::span<const Point3f> origins);
[[nodiscard]] inline Point3f rounded(const Point3d& direction) {
  return {static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(direction.z)};
}

/// For each origin, the number of directions in which a ray hits nothing. Origins are traced in packets of 16 that share a
/// direction, which is fast when the origins lie side by side. Throws Cancelled when `stop` is asked for.
[[nodiscard]] std::vector<std::uint32_t> count_free(const Occluder& occluder, std::span<const Point3f> origins,
                                                    std::span<const Point3d> directions, const std::stop_token& stop = {});

/// What the rays of a cell's receivers meet: a scene, and a box far map beyond it, if there is one.
struct RayScene {
  PlacedScene solid;
  const BoxFarMap* far = nullptr;

  /// A direction that the far map blocks is blocked for all receivers.
  [[nodiscard]] bool is_far_blocked(const Point3d& direction) const { return far != nullptr && far->blocks(direction); }
  [[nodiscard]] bool blocks(const Point3f& p_cell, const Point3f& direction) const;
  /// A bit for each receiver of a packet whose ray in its direction is blocked. `origins` are in the frame of the scene, `wanted`
  /// are the bits of those that are asked.
  [[nodiscard]] std::uint32_t blocked(const RayOrigins& origins, const Occluder::Directions& directions,
                                      std::uint32_t wanted) const;
};

}  // namespace farlod
