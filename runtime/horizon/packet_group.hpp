// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"

namespace farlod {

/// Draws edges for packets that are close to each other: most edges of a cell are culled once for all of them.
/// docs/concepts.md, "Culling edges for a packet".
class PacketGroup {
 public:
  /// The sampling must outlive it, and be that of all horizons.
  explicit PacketGroup(const AzimuthSampling& azimuths) : azimuths_(azimuths) {}

  /// Raises horizons[n] to the edges that the receivers of packets[n] see: to the bit what horizons[n].raise(edges, packets[n])
  /// does.
  void raise(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets, std::span<PacketHorizon> horizons);
  /// Makes `kept` the edges that may rise above one of these horizons, drawn for these packets: the others raise none of them,
  /// and none that is higher.
  void keep_raising(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets,
                    std::span<const PacketHorizon> horizons, SilhouetteEdges& kept);

 private:
  /// Finds the edges that may raise one of these horizons, of receivers within these bounds.
  void find_raising(const SilhouetteEdges& edges, const PacketBounds& bounds, std::span<const PacketHorizon> horizons,
                    std::vector<std::uint16_t>& raising);

  const AzimuthSampling& azimuths_;
  // Working memory, kept from group to group
  std::vector<std::uint16_t> first_, others_;  ///< a bit for each edge of each batch
  std::vector<PacketBounds> bounds_;
  std::vector<const float*> slopes_;
  SilhouetteEdges drawn_;
};

}  // namespace farlod
