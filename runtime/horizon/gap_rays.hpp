// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// The gaps below overhangs in which a packet's receivers may see sky: for each azimuth between two horizons, but not between two
/// others, `filled`.
struct Gaps {
  const PacketHorizon &from, &to;
  const PacketHorizon &filled_from, &filled_to;
  std::span<const PacketHorizon::Row> sky;  ///< view factor of each gap; 0 where there is none
};

/// Removes the smallest gaps of a receiver, of no more sky than `max_sky` in all, and returns their sky.
[[nodiscard]] float remove_smallest_gaps(std::span<PacketHorizon::Row> sky, std::size_t lane, float max_sky);

/// The sky that is seen through gaps, and the number of rays that were traced.
struct SeenInGaps {
  PacketHorizon::Lanes sky{};
  std::uint64_t rays = 0;
};

/// Traces rays in the gaps of the receivers with set bits. A gap that is all of its azimuth's sky gets `rays_per_azimuth` rays, a
/// smaller one its share, and at least one. The sky of each azimuth is added to `of_azimuths`, unless it is empty. Throws
/// Cancelled when `stop` is asked for.
[[nodiscard]] SeenInGaps trace_gaps(const Gaps& gaps, const AzimuthSampling& azimuths, SkyWeight weight,
                                    const ReceiverPacket& receivers, std::uint32_t wanted, std::size_t rays_per_azimuth,
                                    const PlacedScene& scene, const std::stop_token& stop = {},
                                    std::span<PacketHorizon::Row> of_azimuths = {});

}  // namespace farlod
