// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <stop_token>

#include "evaluate/traced_canopy.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"

namespace farlod {

/// 1 − svfaveg of the receivers of a packet: the view of solid things below the sky of their profiles that crowns hide, by some
/// hundred rays. `hidden` takes the terms of all azimuths, which add up to it. What the far city hides is below the sky of a
/// profile, and behind all crowns of the scene. The scene has the frame of the packet. Throws Cancelled when `stop` is asked for.
void find_hidden_behind_crowns(const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths,
                               const CanopyScene& scene, const std::stop_token& stop, std::span<PacketHorizon::Row> hidden);

}  // namespace farlod
