// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "horizon/azimuth_ring.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "package/far_horizon.hpp"

namespace farlod {

/// What a far map says of the city that it does not name, along the azimuths of a ring.
class ResidualHorizon {
 public:
  /// The map must outlive it.
  ResidualHorizon(const FarHorizon& map, const AzimuthRing& ring);

  /// Raise horizons to what hides the sky for certain, likely, and at the most. Below the lowest level of the map nothing is
  /// certain, and what is likely is taken from that level.
  void raise_to_low(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  void raise_to_estimate(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  void raise_to_high(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  /// To where sky may be seen below something of the residual city, at the most.
  void raise_to_overhang(const ReceiverPacket& receivers, PacketHorizon& horizon) const;

 private:
  using Patch = std::optional<std::uint32_t>;
  [[nodiscard]] Patch patch_of(const ReceiverPacket& receivers, std::size_t lane) const;
  /// The same, but that of the lowest level for those below it.
  [[nodiscard]] Patch patch_or_lowest(const ReceiverPacket& receivers, std::size_t lane) const;
  [[nodiscard]] std::span<const float> low_row(Patch patch) const {
    return patch ? map_.row(map_.low, *patch) : std::span<const float>(level_);
  }
  [[nodiscard]] std::span<const float> high_row(Patch patch) const {
    return patch ? map_.row(map_.high, *patch) : std::span<const float>(infinite_);
  }
  [[nodiscard]] std::span<const float> overhang_row(Patch patch) const {
    return patch ? map_.row(map_.overhang, *patch) : std::span<const float>(infinite_);
  }

  const FarHorizon& map_;
  bool is_grounded_;  ///< none of it overhangs
  std::vector<std::uint32_t> bin_of_azimuth_;
  std::vector<float> level_, infinite_;
};

}  // namespace farlod
