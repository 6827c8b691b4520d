// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/azimuth_ring.hpp"
#include "horizon/overhang_geometry.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {

/// The sky that a packet's receivers may see below something: for each azimuth between two horizons, but not between two others.
struct Gaps {
  const PacketHorizon &from, &to;
  const PacketHorizon &filled_from, &filled_to;
  std::span<const PacketHorizon::Row> sky;  ///< how much that is
};

/// Closes the smallest gaps of a receiver, of no more sky than `most` altogether, and returns how much that is.
[[nodiscard]] float close_smallest(std::span<PacketHorizon::Row> sky, std::size_t lane, float most);

/// Traces `rays_per_azimuth` rays in the gaps of the receivers whose bits are set, and returns how much sky is seen through them.
[[nodiscard]] PacketHorizon::Lanes trace_gaps(const Gaps& gaps, const AzimuthRing& ring, SkyWeight weight,
                                              const ReceiverPacket& receivers, std::uint32_t wanted, std::size_t rays_per_azimuth,
                                              const PlacedScene& scene);

}  // namespace farlod
