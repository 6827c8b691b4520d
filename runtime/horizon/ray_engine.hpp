// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "farlod/far_map/far_horizon.hpp"
#include "horizon/cell_skyline.hpp"
#include "horizon/hanging_city.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/ray_fan.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/unnamed_city.hpp"
#include "occlusion/occluder.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Of a receiver's rays, how many reach the sky: at the least, likely, and at the most.
struct FreeRays {
  std::uint32_t low = 0, likely = 0, high = 0;
};

/// Counts the rays that reach the sky, for packets of receivers that look in the same directions. What stands solidly is told
/// from the receivers' horizons, and so is the far city; only rays that pass below the outline of something that hangs are
/// traced.
class RayEngine {
 public:
  /// All must outlive it; `scene` holds the triangles of `hanging`. For receivers of one cell. Without `wants_bounds`, low = high
  /// = likely.
  RayEngine(const RayFan& fan, const FarHorizon& far, const CellSkyline& skyline, const HangingCity& hanging,
            const Occluder& scene, bool wants_bounds);

  /// For up to ReceiverPacket::lanes receivers.
  [[nodiscard]] std::vector<FreeRays> count(std::span<const Receiver> receivers);

  /// Traces what the far map left open for the doubtful (by bits) among the receivers that were counted last, against everything;
  /// `origins` are the same receivers in the frame of `city`. Needs `wants_bounds`. Returns the number of rays.
  std::uint64_t settle(const Occluder& city, const RayOrigins& origins, std::uint32_t doubtful, std::span<FreeRays> free) const;

 private:
  void look(std::span<const Receiver> receivers);
  void look_unnamed();
  /// Finds the rays that meet something hanging.
  void trace();
  void trace(std::size_t azimuth, std::uint32_t wanted);

  /// Rays that pass over what is hidden for certain, and meet something hanging, by bits of receivers.
  struct Blocked {
    std::uint32_t azimuth, bits;
  };

  const RayFan& fan_;
  const CellSkyline& skyline_;
  const HangingCity& hanging_;
  const Occluder& scene_;
  bool wants_bounds_;
  UnnamedCity unnamed_;
  ReceiverPacket packet_;
  RayOrigins origins_;
  /// Below `hidden_` nothing is free, above `open_` the far map lets everything pass, and `likely_` lies between. Without bounds,
  /// only `likely_` is known, and `hidden_` is the same.
  PacketHorizon hidden_, likely_, open_, outlines_;
  std::vector<Blocked> blocked_;
  std::vector<std::uint32_t> azimuths_;
};

}  // namespace farlod
