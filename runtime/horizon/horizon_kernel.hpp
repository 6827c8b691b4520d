// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "horizon/azimuth_ring.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"

namespace farlod {

/// The kernel of PacketHorizon: raises `slopes`, a row of receivers for each azimuth of the ring, to what the receivers see of
/// some edges.
void raise_horizons(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const AzimuthRing& ring, float* slopes);

/// Lowers `lowest` to what the receivers see of some edges above `floors`.
void lower_to_edges(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const AzimuthRing& ring, const float* floors,
                    float* lowest);

}  // namespace farlod
