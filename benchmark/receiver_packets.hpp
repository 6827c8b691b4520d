// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "benchmark/city_receivers.hpp"
#include "farlod/point.hpp"

namespace farlod::benchmark {

/// One packet of Embree.
inline constexpr std::size_t packet_lanes = 16;

/// Neighboring receivers that look the same way, so that they can share each direction. In the frame of WholeCity.
struct SharedPacket {
  Point3f normal;
  std::size_t count = 0;
  std::array<Point3f, packet_lanes> p_scene;
  std::array<std::size_t, packet_lanes> index{};
};

/// Puts the receivers of each cell into packets: those of one surface along a curve over it. Ground receivers come as patches of
/// 4 × 4 pixels already.
[[nodiscard]] std::vector<SharedPacket> packets_of(const Grid& grid, const CityReceivers& receivers);

}  // namespace farlod::benchmark
