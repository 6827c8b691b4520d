// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"

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

}  // namespace farlod
