// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/receiver_packet.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The receivers of a cell, divided into packets that see alike: a packet is drawn the faster, the nearer its receivers stand to
/// each other and the more they look the same way.
struct PacketOrder {
  std::vector<std::uint32_t> numbers;  ///< places of the receivers in their list, packet by packet
  std::vector<std::uint32_t> ends;     ///< of each packet, in `numbers`
};

///   (1) each receiver is in one packet
///   (2) a packet has between one and ReceiverPacket::lanes receivers
///   (3) the receivers alone decide
[[nodiscard]] PacketOrder packet_order(std::span<const Receiver> receivers);

/// Calls `visit(packet, numbers)` for each packet.
template <class Visit>
void for_each_packet(std::span<const Receiver> receivers, const PacketOrder& order, const Visit& visit) {
  std::size_t first = 0;
  for (const std::uint32_t end : order.ends) {
    const auto numbers = std::span(order.numbers).subspan(first, end - first);
    ReceiverPacket packet;
    for (const std::uint32_t n : numbers) packet.add(receivers[n]);
    visit(packet, numbers);
    first = end;
  }
}

}  // namespace farlod
