// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// For each origin, how many of the directions meet nothing. Neighboring origins should see alike: 16 of them share a
/// direction in one packet.
[[nodiscard]] std::vector<std::uint32_t> count_free(const Occluder& occluder, std::span<const Point3f> origins,
                                                    std::span<const Point3d> directions);

}  // namespace farlod
