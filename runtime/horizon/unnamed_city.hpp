// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "farlod/far_map/far_horizon.hpp"
#include "horizon/azimuth_ring.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {

/// What a far map says of the city that it does not name, along the azimuths of a ring.
class UnnamedCity {
 public:
  /// The map must outlive it.
  UnnamedCity(const FarHorizon& map, const AzimuthRing& ring);

  /// Raise horizons to what hides the sky for certain, likely, and at the most. Below the lowest level of the map nothing is
  /// certain, and what is likely is taken from that level.
  void raise_lower(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  void raise_likely(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  void raise_upper(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  /// To where sky may be seen below something that is not named, at the most.
  void raise_overhang(const ReceiverPacket& receivers, PacketHorizon& horizon) const;

 private:
  using Patch = std::optional<std::uint32_t>;
  [[nodiscard]] Patch patch_of(const ReceiverPacket& receivers, std::size_t lane) const;
  /// The same, but that of the lowest level for those below it.
  [[nodiscard]] Patch patch_or_lowest(const ReceiverPacket& receivers, std::size_t lane) const;
  [[nodiscard]] std::span<const float> lower_row(Patch patch) const {
    return patch ? map_.row(map_.lower, *patch) : std::span<const float>(level_);
  }
  [[nodiscard]] std::span<const float> upper_row(Patch patch) const {
    return patch ? map_.row(map_.upper, *patch) : std::span<const float>(infinite_);
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
