// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/horizon_engine.hpp"

namespace farlod {

using Evaluate = void (HorizonEngine::*)(std::span<const ReceiverPacket>, std::span<PacketAnswer>);

/// Answers receivers packet by packet. Returns the numbers of those that needed rays.
inline std::vector<std::uint32_t> packet_by_packet(HorizonEngine& engine, std::span<const Receiver> receivers,
                                                   std::span<SvfInterval> intervals, Evaluate answer) {
  std::vector<std::uint32_t> by_rays;
  for (std::uint32_t first = 0; first < receivers.size(); first += ReceiverPacket::lanes) {
    const std::size_t count = std::min(ReceiverPacket::lanes, receivers.size() - first);
    ReceiverPacket packet;
    for (const Receiver& r : receivers.subspan(first, count)) packet.add(r);
    PacketAnswer of_packet;
    (engine.*answer)({&packet, 1}, {&of_packet, 1});
    std::copy_n(of_packet.svf.begin(), count, intervals.begin() + first);
    for (std::uint32_t l = 0; l < count; ++l)
      if (((of_packet.by_rays >> l) & 1U) != 0) by_rays.push_back(first + l);
  }
  return by_rays;
}

}  // namespace farlod
