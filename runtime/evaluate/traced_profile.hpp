// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "evaluate/visibility.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"

namespace farlod {

/// Makes the profile of a packet by rays: at each azimuth one in the middle of each degree of elevation; then the ends of the sky
/// and of what is hidden are halved until they are known to a 256th of a degree. What is smaller than a degree may be missed. All
/// between the lowest free ray and the sky is one gap. The profile has no rows of sky. Throws Cancelled when `stop` is asked for.
void trace_profile(const AzimuthSampling& azimuths, const RayScene& scene, const ReceiverPacket& receivers, SkyProfile& profile,
                   const std::stop_token& stop);

}  // namespace farlod
