// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// A bit for each receiver of a packet whose ray in its direction is blocked; `wanted` are the bits of those that are asked.
using BlockedRays = std::function<std::uint32_t(const Occluder::Directions& directions, std::uint32_t wanted)>;

/// The same for a packet that is named.
using BlockedRaysOfPacket =
    std::function<std::uint32_t(const ReceiverPacket& packet, const Occluder::Directions& directions, std::uint32_t wanted)>;

/// Makes a profile of rays: at each azimuth one in the middle of each degree of elevation; then the ends of the sky and of what
/// is hidden are halved until they are known to a 256th of a degree. What is smaller than a degree may be missed. All between the
/// lowest free ray and the sky is one gap. The profile has no rows of sky. Throws Cancelled when `stop` is asked for.
void trace_profile(const AzimuthSampling& azimuths, const BlockedRays& blocked, std::uint32_t wanted, SkyProfile& profile,
                   const std::stop_token& stop);

}  // namespace farlod
