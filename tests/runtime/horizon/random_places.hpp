// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {

/// Places, edges and directions that are the same on every machine.
class RandomPlaces {
 public:
  [[nodiscard]] float between(double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  [[nodiscard]] Point3f place(double reach_m, double z_low_m, double z_high_m) {
    const float x = between(-reach_m, reach_m), y = between(-reach_m, reach_m);
    return {x, y, between(z_low_m, z_high_m)};
  }
  [[nodiscard]] HorizonEdge edge(double reach_m, double z_low_m, double z_high_m) {
    const Point3f a = place(reach_m, z_low_m, z_high_m);
    return {a, place(reach_m, z_low_m, z_high_m)};
  }
  /// Of length 1, with this z.
  [[nodiscard]] Point3f direction_at(double z) {
    const double azimuth = between(0.0, 2.0 * std::numbers::pi), across = std::sqrt(1.0 - z * z);
    return {static_cast<float>(across * std::cos(azimuth)), static_cast<float>(across * std::sin(azimuth)),
            static_cast<float>(z)};
  }

 private:
  std::mt19937_64 random_{20120901};
};

[[nodiscard]] inline SilhouetteEdges silhouettes_of(std::span<const HorizonEdge> edges) {
  SilhouetteEdges silhouettes;
  for (const HorizonEdge& e : edges) silhouettes.add(e);
  return silhouettes;
}

[[nodiscard]] inline ReceiverPacket packet_of(std::span<const Point3f> places, const Point3f& normal = {0.0F, 0.0F, 1.0F}) {
  ReceiverPacket packet;
  for (const Point3f& p : places) packet.add({0, p, normal});
  return packet;
}

/// Caps of a PacketHorizon that raise all receivers, or only one.
inline constexpr ReceiverPacket::Lanes everybody = [] {
  ReceiverPacket::Lanes caps{};
  caps.fill(std::numeric_limits<float>::infinity());
  return caps;
}();
[[nodiscard]] inline ReceiverPacket::Lanes only(std::size_t lane) {
  ReceiverPacket::Lanes caps{};
  caps[lane] = std::numeric_limits<float>::infinity();
  return caps;
}

}  // namespace farlod
