// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhang_geometry.hpp"
#include "horizon/overhang_horizons.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/ray_fan.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/residual_horizon.hpp"
#include "occlusion/occluder.hpp"
#include "package/far_horizon.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Of a receiver's rays, how many reach the sky: at the least, likely, and at the most.
struct FreeRays {
  std::uint32_t low = 0, estimate = 0, high = 0;
};

/// Counts the rays that reach the sky, for packets of receivers that look in the same directions. Whether a ray is blocked
/// follows from the receivers' horizons; only rays that may pass below something that overhangs are traced.
class RayEngine {
 public:
  /// All must outlive it. For receivers of one cell. Without `wants_bounds`, low = high = likely.
  RayEngine(const RayFan& fan, const FarHorizon& far, const CellSilhouettes& silhouettes, OverhangGeometry& overhangs, bool wants_bounds);

  /// For up to ReceiverPacket::lanes receivers.
  [[nodiscard]] std::vector<FreeRays> count(std::span<const Receiver> receivers);

  /// Traces what the far map left open for the doubtful (by bits) among the receivers that were counted last, against everything;
  /// `origins` are the same receivers in the frame of `city`. Needs `wants_bounds`. Returns the number of rays.
  std::uint64_t retrace(const Occluder& city, const RayOrigins& origins, std::uint32_t doubtful, std::span<FreeRays> free) const;

 private:
  void look(std::span<const Receiver> receivers);
  /// Finds the rays that pass below something.
  void trace();
  /// A bit for each receiver whose ray passes below a border.
  [[nodiscard]] static std::uint32_t in_gap(const OverhangHorizons& horizons, std::uint32_t azimuth, float slope);

  /// Rays that pass below something and meet nothing near, by bits of receivers: likely, and possibly.
  struct Passing {
    std::uint32_t azimuth, estimate, possible;
  };

  const RayFan& fan_;
  const CellSilhouettes& silhouettes_;
  OverhangGeometry& overhangs_;
  bool wants_bounds_;
  ResidualHorizon residual_;
  ReceiverPacket packet_;
  /// Without bounds, only what is likely is known. Above `open_` everything passes.
  OverhangHorizons estimate_, certain_;
  PacketHorizon open_;
  std::vector<Passing> passing_;
};

}  // namespace farlod
