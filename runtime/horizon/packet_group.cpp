// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/packet_group.hpp"

#include "base/expects.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

/// Fewer packets are faster alone.
constexpr std::size_t least_packets = 4;

}  // namespace

void PacketGroup::raise(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets,
                        std::span<PacketHorizon> horizons) {
  FARLOD_EXPECTS(packets.size() == horizons.size());
  if (packets.size() < least_packets || edges.empty()) {
    for (std::size_t n = 0; n < packets.size(); ++n) horizons[n].raise(edges, packets[n]);
    return;
  }
  bounds_.clear();
  for (const ReceiverPacket& packet : packets) bounds_.push_back(bounds_of(packet));
  // The packet in the middle goes first: most of what it sees in the end, the others see too
  const std::size_t middle = packets.size() / 2;
  horizons[middle].raise(edges, packets[middle], bounds_[middle], Culling::renewed);
  find_raising(edges, bounds_[middle], horizons.subspan(middle, 1), first_);
  drawn_.assign(edges, first_);
  for (std::size_t n = 0; n < packets.size(); ++n)
    if (n != middle) horizons[n].raise(drawn_, packets[n], bounds_[n], Culling::none);
  // Then those of the other edges that may rise above some of the horizons that this gave
  find_raising(edges, joined(bounds_), horizons, others_);
  for (std::size_t batch = 0; batch < others_.size(); ++batch) others_[batch] &= static_cast<std::uint16_t>(~first_[batch]);
  drawn_.assign(edges, others_);
  for (std::size_t n = 0; n < packets.size(); ++n)
    if (n != middle) horizons[n].raise(drawn_, packets[n], bounds_[n], Culling::once);
}

void PacketGroup::keep_raising(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets,
                               std::span<const PacketHorizon> horizons, SilhouetteEdges& kept) {
  others_.clear();
  if (!edges.empty()) {
    bounds_.clear();
    for (const ReceiverPacket& packet : packets) bounds_.push_back(bounds_of(packet));
    find_raising(edges, joined(bounds_), horizons, others_);
  }
  kept.assign(edges, others_);
}

void PacketGroup::find_raising(const SilhouetteEdges& edges, const PacketBounds& bounds, std::span<const PacketHorizon> horizons,
                               std::vector<std::uint16_t>& raising) {
  slopes_.clear();
  for (const PacketHorizon& horizon : horizons) slopes_.push_back(horizon.slopes());
  raising.resize(edges.batches().size());
  edge_kernels().find_raising({edges.batches(), edges.role()}, bounds, slopes_, azimuths_.view(), raising.data());
}

}  // namespace farlod
