// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "package/far_map.hpp"

namespace farlod {

/// The residual horizon of a far map, of all occluders that it does not store one by one, at the azimuths of a sampling.
class ResidualHorizon {
 public:
  /// The map must outlive it.
  ResidualHorizon(const FarHorizon& map, const AzimuthSampling& azimuths);

  /// Raise horizons to the residual's low bound, its estimate and its high bound. Below the lowest level of the map, the bounds
  /// are 0 and infinite, and the estimate is that of the lowest level.
  void raise_to_low(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  void raise_to_estimate(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  void raise_to_high(const ReceiverPacket& receivers, PacketHorizon& horizon) const;
  /// Rows of wedges (wedge_kernels.hpp): the low bound of all their bins, their high bound, and that of lower borders: all, and
  /// those below the low bound.
  struct InWedges {
    std::vector<PacketHorizon::Row> least, most, overhang, overhang_below_low;
    std::vector<std::uint8_t> reached_below_low;                              ///< whether there is one for any receiver
    std::array<std::optional<std::uint32_t>, ReceiverPacket::lanes> patches;  ///< that these are of
  };
  /// Rows of an earlier call are kept where they are right.
  void find_in_wedges(const ReceiverPacket& receivers, InWedges& rows) const;
  /// Nothing in the residual city overhangs.
  [[nodiscard]] bool is_grounded() const { return is_grounded_; }
  /// To the upper bound of the residual's lower borders: below it, sky may be seen under an overhang.
  void raise_to_overhang(const ReceiverPacket& receivers, PacketHorizon& horizon) const;

 private:
  /// Sets each wedge of the receivers with caps to the chosen slope of its bins.
  template <class Choose>
  void fill_wedges(std::span<const float> row, const PacketHorizon::Lanes& caps, const Choose& choose,
                   std::vector<PacketHorizon::Row>& wedges) const;
  using Patch = std::optional<std::uint32_t>;
  [[nodiscard]] Patch patch_of(const ReceiverPacket& receivers, std::size_t lane) const;
  /// The same, but the lowest patch for receivers below it.
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
  bool is_grounded_;  ///< the residual has no overhangs
  std::vector<std::uint32_t> bin_of_azimuth_;
  std::vector<float> level_, infinite_;
};

}  // namespace farlod
