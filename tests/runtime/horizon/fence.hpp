// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// A wall without thickness from one height up to another one, all around the middle of the cell, as a square of 40 m.
inline Occluder fence(float low_m, float high_m) {
  const std::array<std::array<float, 2>, 4> plan{{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}};
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t n = 0; n < 4; ++n) {
    const auto [px, py] = plan[n];
    const auto [qx, qy] = plan[(n + 1) % 4];
    vertices.insert(vertices.end(), {{px, py, low_m}, {qx, qy, low_m}, {qx, qy, high_m}, {px, py, high_m}});
    triangles.push_back({4 * n, 4 * n + 1, 4 * n + 2});
    triangles.push_back({4 * n, 4 * n + 2, 4 * n + 3});
  }
  return {vertices, triangles};
}

/// From a receiver to the side of the square that an azimuth meets first.
inline double distance_to_fence(const ReceiverPacket& packet, std::size_t lane, double cosine, double sine) {
  return std::min((cosine > 0.0 ? 20.0 - packet.x[lane] : 20.0 + packet.x[lane]) / std::abs(cosine),
                  (sine > 0.0 ? 20.0 - packet.y[lane] : 20.0 + packet.y[lane]) / std::abs(sine));
}

}  // namespace farlod
