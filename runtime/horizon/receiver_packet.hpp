// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "base/expects.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Whether a set of lanes, a bit each, holds this one.
[[nodiscard]] constexpr bool has_bit(std::uint32_t bits, std::size_t lane) { return ((bits >> lane) & 1U) != 0; }

/// Receivers that are computed at once, coordinate by coordinate. Lanes without a receiver repeat the last one. Cell frame.
struct ReceiverPacket {
  static constexpr std::size_t lanes = 16;
  using Lanes = std::array<float, lanes>;

  alignas(64) Lanes x{}, y{}, z{}, normal_x{}, normal_y{}, normal_z{};
  std::size_t count = 0;

  ReceiverPacket() = default;
  /// The receivers of these numbers, of which there is one at least.
  ReceiverPacket(std::span<const Receiver> receivers, std::span<const std::uint32_t> numbers) : count(numbers.size()) {
    FARLOD_EXPECTS(0 < count && count <= lanes);
    for (std::size_t l = 0; l < lanes; ++l) set(l, receivers[numbers[std::min(l, count - 1)]]);
  }

  void add(const Receiver& r) {
    FARLOD_EXPECTS(count < lanes);
    for (std::size_t l = count; l < lanes; ++l) set(l, r);
    ++count;
  }
  /// A bit for each receiver.
  [[nodiscard]] std::uint32_t lanes_in_use() const { return static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1); }
  [[nodiscard]] float lowest_z() const { return *std::min_element(z.begin(), z.end()); }
  /// All of the normal counts: its z is 1 also where it leans by .0002 rad, which changes a sky view factor by up to .0001.
  [[nodiscard]] bool looks_straight_up(std::size_t lane) const {
    return normal_x[lane] == 0.0F && normal_y[lane] == 0.0F && normal_z[lane] > 0.0F;
  }
  [[nodiscard]] bool all_look_straight_up() const {
    bool all_do = true;
    for (std::size_t l = 0; l < lanes; ++l) all_do = all_do && looks_straight_up(l);
    return all_do;
  }

 private:
  void set(std::size_t lane, const Receiver& r) {
    x[lane] = r.p_cell.x;
    y[lane] = r.p_cell.y;
    z[lane] = r.p_cell.z;
    normal_x[lane] = r.normal.x;
    normal_y[lane] = r.normal.y;
    normal_z[lane] = r.normal.z;
  }
};

inline constexpr std::size_t packet_lanes = ReceiverPacket::lanes;

/// Takes over the numbers of some receivers, a bit each.
inline void copy_lanes(const ReceiverPacket::Lanes& from, std::uint32_t some, ReceiverPacket::Lanes& to) {
  for (std::size_t l = 0; l < packet_lanes; ++l)
    if (has_bit(some, l)) to[l] = from[l];
}

/// An upright box around receivers: the centre of its plan, half its sides, and its lowest and highest z.
struct CenteredBox {
  float x = 0.0F, y = 0.0F, half_x = 0.0F, half_y = 0.0F, low_z = 0.0F, high_z = 0.0F;
};

/// Bounds of a packet: a box around its receivers, and a plane normal · p = depth that all of them lie on or in front of. No
/// receiver counts sky behind the plane. Without such a plane the normal is 0 and the depth −1: all places are in front.
struct PacketBounds {
  CenteredBox box;
  float normal_x = 0.0F, normal_y = 0.0F, normal_z = 0.0F, depth = -1.0F;
};
[[nodiscard]] PacketBounds bounds_of(const ReceiverPacket& receivers);
/// Bounds of all the packets that these are the bounds of. There is a plane if all have one with the same normal.
[[nodiscard]] PacketBounds joined(std::span<const PacketBounds> bounds);

/// Packets of a group, unless gaps between their receivers make more of them.
inline constexpr std::size_t packets_in_group = 16;

/// The receivers of a cell, divided into packets. A packet is computed the faster, the nearer its receivers are to each other and
/// the more alike their normals.
struct PacketOrder {
  std::vector<std::uint32_t> numbers;  ///< places of the receivers in their list, packet by packet
  std::vector<std::uint32_t> ends;     ///< of each packet, in `numbers`
  /// Consecutive packets that are near each other form a group: the end of each, in `ends`. A group of `lanes` receivers a packet
  /// has at most `packets_in_group` packets.
  std::vector<std::uint32_t> group_ends;
};

///   (1) each receiver is in one packet
///   (2) a packet has between one and ReceiverPacket::lanes receivers
///   (3) the order depends on the receivers alone
/// Throws Cancelled when `stop` is asked for.
[[nodiscard]] PacketOrder packet_order(std::span<const Receiver> receivers, const std::stop_token& stop = {});

/// Calls `visit(packets, numbers)` for each group, with the numbers of its receivers, packet by packet.
template <class Visit>
void for_each_group(std::span<const Receiver> receivers, const PacketOrder& order, const Visit& visit) {
  std::vector<ReceiverPacket> packets;
  std::size_t packet = 0, first = 0;
  for (const std::uint32_t group_end : order.group_ends) {
    const std::size_t group_first = first;
    packets.clear();
    for (; packet < group_end; ++packet) {
      packets.emplace_back(receivers, std::span(order.numbers).subspan(first, order.ends[packet] - first));
      first = order.ends[packet];
    }
    visit(std::span<const ReceiverPacket>(packets), std::span(order.numbers).subspan(group_first, first - group_first));
  }
}

}  // namespace farlod
