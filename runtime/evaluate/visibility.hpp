// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// What is nearer than this is not seen: a receiver that stands exactly on a surface would see nothing else. Twice the rounding
/// of a coordinate 5 km from a scene's origin.
inline constexpr float least_distance_m = 0.001F;

/// For each origin, how many of the directions meet nothing. Neighbouring origins should see alike: 16 of them share a
/// direction in one packet.
[[nodiscard]] std::vector<std::uint32_t> count_free(const Occluder& occluder, std::span<const Point3f> origins,
                                                    std::span<const Point3d> directions);

/// Origins that are asked together: one packet of Embree.
inline constexpr std::size_t origins_per_packet = 16;

/// Which rays meet nothing: for up to `origins_per_packet` origins, those rays that are wanted. Both tables hold a row of
/// origins for each direction; what is not wanted comes out as 0.
void find_free(const Occluder& occluder, std::span<const Point3f> origins, std::span<const Point3d> directions,
               std::span<const std::uint8_t> wanted, std::span<std::uint8_t> free);

}  // namespace farlod
