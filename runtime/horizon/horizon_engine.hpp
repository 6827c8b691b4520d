// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/far_map/far_horizon.hpp"
#include "farlod/sky/sky_partition.hpp"
#include "horizon/azimuth_ring.hpp"
#include "horizon/cell_skyline.hpp"
#include "horizon/hanging_city.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/unnamed_city.hpp"

namespace farlod {

/// A sky view factor, and the bounds that the far map leaves it.
struct BoundedShare {
  float low = 0.0F, likely = 0.0F, high = 0.0F;
};

/// Sky view factors from horizons: edges are drawn from where each receiver stands, and the sky above them is integrated. For
/// receivers of one cell.
class HorizonEngine {
 public:
  /// All must outlive it.
  HorizonEngine(const AzimuthRing& ring, SkyWeight weight, const FarHorizon& far, const CellSkyline& skyline,
                const HangingCity& hanging);

  /// Answers the receivers of a packet in `shares`, in their order; low = likely = high. Returns a bit for each that sees
  /// something over its horizon that does not stand solidly: its answer is too high.
  [[nodiscard]] std::uint32_t evaluate(const ReceiverPacket& receivers, std::span<BoundedShare> shares);
  /// The same with bounds.
  [[nodiscard]] std::uint32_t evaluate_with_bounds(const ReceiverPacket& receivers, std::span<BoundedShare> shares);

 private:
  /// Who sees something hanging above the horizon as drawn.
  [[nodiscard]] std::uint32_t see_hanging(const ReceiverPacket& receivers);

  SkyWeight weight_;
  const CellSkyline& skyline_;
  const HangingCity& hanging_;
  UnnamedCity unnamed_;
  PacketHorizon horizon_, outlines_;
};

}  // namespace farlod
