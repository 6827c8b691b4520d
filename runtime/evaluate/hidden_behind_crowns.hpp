// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "evaluate/traced_canopy.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"

namespace farlod {

/// 1 − svfaveg of the receivers of a packet: the view of solid things below the sky of their profiles that crowns hide, by some
/// hundred rays. What the far city hides is below the sky of a profile, and behind all crowns of the scene. The scene has the
/// frame of the packet. Throws Cancelled when `stop` is asked for.
[[nodiscard]] ReceiverPacket::Lanes hidden_behind_crowns(const SkyProfile& profile, const ReceiverPacket& receivers,
                                                         const AzimuthSampling& azimuths, const CanopyScene& scene,
                                                         const std::stop_token& stop);

}  // namespace farlod
