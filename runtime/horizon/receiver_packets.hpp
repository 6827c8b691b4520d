// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/receiver_packet.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Orders the receivers of a cell so that those in a row see alike: first by where they look, then along a space-filling curve
/// (Morton order), to be cut into packets. Gives the places of the receivers in their list. Receivers that look the same way and
/// are neighbours in the list already, as those of a raster are, stay in its order.
[[nodiscard]] std::vector<std::uint32_t> packet_order(std::span<const Receiver> receivers);

/// Calls `visit(packet, numbers)` for each packet of the receivers that `order` numbers.
template <class Visit>
void for_each_packet(std::span<const Receiver> receivers, std::span<const std::uint32_t> order, const Visit& visit) {
  for (std::size_t first = 0; first < order.size(); first += ReceiverPacket::lanes) {
    const auto numbers = order.subspan(first, std::min(ReceiverPacket::lanes, order.size() - first));
    ReceiverPacket packet;
    for (const std::uint32_t n : numbers) packet.add(receivers[n]);
    visit(packet, numbers);
  }
}

}  // namespace farlod
