// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_ring.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhang_geometry.hpp"
#include "horizon/overhang_horizons.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/residual_horizon.hpp"
#include "horizon/sky_partition.hpp"
#include "package/far_horizon.hpp"

namespace farlod {

/// A sky view factor, and the bounds that are certain for the same azimuths.
struct SvfInterval {
  float low = 0.0F, estimate = 0.0F, high = 0.0F;
};

/// What is done where sky may be seen below something that overhangs.
struct GapSettings {
  /// Sky view factors that are certain to so much need no rays: the middle is taken.
  float tolerance = 0.0F;
  std::size_t rays_per_azimuth = 4;
};

/// Sky view factors from horizons: edges are drawn from where each receiver stands, and the sky above them is integrated. For
/// receivers of one cell. docs/concepts.md, "What is grounded, and what overhangs".
class HorizonEngine {
 public:
  /// All must outlive it.
  HorizonEngine(const AzimuthRing& ring, SkyWeight weight, const FarHorizon& far, const CellSilhouettes& silhouettes,
                OverhangGeometry& overhangs, const GapSettings& gaps);

  /// Answers the receivers of a packet in `shares`, in their order; low = estimate = high. Returns a bit for each that needed rays.
  [[nodiscard]] std::uint32_t evaluate(const ReceiverPacket& receivers, std::span<SvfInterval> shares);
  /// The same with bounds.
  [[nodiscard]] std::uint32_t evaluate_with_bounds(const ReceiverPacket& receivers, std::span<SvfInterval> shares);

 private:
  using Lanes = PacketHorizon::Lanes;
  /// Sky that is seen below something, and who needed rays for that.
  struct BelowBorders {
    Lanes sky{};
    std::uint32_t by_rays = 0;
  };
  /// Between the grounded horizons and the borders, as drawn.
  [[nodiscard]] BelowBorders look_below(const ReceiverPacket& receivers);

  const AzimuthRing& ring_;
  SkyWeight weight_;
  const CellSilhouettes& silhouettes_;
  OverhangGeometry& overhangs_;
  GapSettings gaps_;
  ResidualHorizon residual_;
  OverhangHorizons horizons_;
  PacketHorizon near_and_explicit_;
  std::vector<PacketHorizon::Row> gap_rows_;
};

}  // namespace farlod
