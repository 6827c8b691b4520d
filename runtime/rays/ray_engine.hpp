// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "base/cancellation.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/recesses.hpp"
#include "horizon/residual_horizon.hpp"
#include "occlusion/occluder.hpp"
#include "package/far_map.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// How many of a receiver's rays reach the sky: the estimate, and what the far map may change of it.
struct FreeRays {
  std::uint32_t low = 0, estimate = 0, high = 0;
};

/// Counts the rays that reach the sky, for packets of receivers that share their directions. A ray above a receiver's horizon is
/// free; only rays in the gaps below overhangs are traced.
class RayEngine {
 public:
  /// All must outlive it. For receivers of one cell. Without `wants_bounds`, low = high = estimate.
  /// When `stop` is asked for, count() ends with Cancelled.
  RayEngine(const DirectionSampling& directions, const FarHorizon& far, const CellSilhouettes& silhouettes,
            OverhangGeometry& overhangs, bool wants_bounds, std::stop_token stop = {});

  /// For up to ReceiverPacket::lanes receivers.
  [[nodiscard]] std::vector<FreeRays> count(std::span<const Receiver> receivers);

 private:
  void draw_horizons(std::span<const Receiver> receivers);
  void draw_bounds(const Overhead& overhead);
  /// A loop over the directions looks from time to time whether an end is asked for.
  void look_for_stop(std::uint32_t k) const {
    if (k % directions_between_looks == 0) throw_if_cancelled(stop_);
  }
  /// Finds the rays that pass through gaps.
  void trace_gaps();
  /// A bit for each receiver whose ray lies in a gap.
  [[nodiscard]] static std::uint32_t in_gap(const OverhangHorizons& horizons, std::uint32_t azimuth, float slope);

  /// A ray in a gap that no near occluder blocks: bits of the receivers for which it is free, by the estimate and by the high
  /// bound.
  struct GapRay {
    std::uint32_t azimuth, estimate, high;
  };

  const DirectionSampling& directions_;
  const CellSilhouettes& silhouettes_;
  OverhangGeometry& overhangs_;
  bool wants_bounds_;
  std::stop_token stop_;
  ResidualHorizon residual_;
  Recesses recesses_;
  ReceiverPacket packet_;
  /// The horizons that give the estimate, the high count and the low count. A low horizon gives a high count. Without bounds,
  /// only the first are drawn.
  OverhangHorizons for_estimate_, for_high_;
  PacketHorizon for_low_;
  std::vector<GapRay> gap_rays_;
};

}  // namespace farlod
