// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// For each origin, the number of directions in which a ray hits nothing. Origins are traced in packets of 16 that share a
/// direction, which is fast when the origins lie side by side.
[[nodiscard]] std::vector<std::uint32_t> count_free(const Occluder& occluder, std::span<const Point3f> origins,
                                                    std::span<const Point3d> directions);

}  // namespace farlod
