// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/receiver_packets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr Point3f up{0.0F, 0.0F, 1.0F}, east{1.0F, 0.0F, 0.0F}, south{0.0F, -1.0F, 0.0F};

std::vector<Receiver> random_receivers(std::size_t count, const std::vector<Point3f>& normals) {
  RandomPlaces random;
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < count; ++n)
    receivers.push_back({n, random.place(50.0, -5.0, 60.0),
                         normals[static_cast<std::size_t>(random.between(0.0, 0.999 * static_cast<double>(normals.size())))]});
  return receivers;
}

TEST(PacketOrder, HoldsEachReceiverOnce) {
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 500U}) {
    std::vector<std::uint32_t> order = packet_order(random_receivers(count, {up, east, south}));
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all);
  }
}

TEST(PacketOrder, RastersStayAsTheyAre) {
  std::vector<std::uint32_t> all(100);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(packet_order(random_receivers(100, {up})), all);
}

TEST(PacketOrder, ThoseWhoLookAlikeAreTogether) {
  const std::vector<Receiver> receivers = random_receivers(300, {up, east, south});
  const std::vector<std::uint32_t> order = packet_order(receivers);
  int changes = 0;
  for (std::size_t n = 1; n < order.size(); ++n) changes += receivers[order[n]].normal == receivers[order[n - 1]].normal ? 0 : 1;
  EXPECT_EQ(changes, 2);
}

TEST(PacketOrder, NeighboursAreTogether) {
  const std::vector<Receiver> receivers = random_receivers(4000, {east, south});
  const auto length = [&](const std::vector<std::uint32_t>& order) {
    double sum = 0.0;
    for (std::size_t n = 1; n < order.size(); ++n) sum += norm(receivers[order[n]].p_cell - receivers[order[n - 1]].p_cell);
    return sum / static_cast<double>(order.size());
  };
  std::vector<std::uint32_t> as_given(receivers.size());
  std::iota(as_given.begin(), as_given.end(), 0U);
  // 2000 in 100 m x 100 m x 65 m stand 7 m apart; at random they are 60 m apart
  EXPECT_LT(length(packet_order(receivers)), length(as_given) / 3.0);
}

TEST(ReceiverPackets, CoverTheOrderOnceAndTheLastIsPartial) {
  const std::vector<Receiver> receivers = random_receivers(37, {up, east});
  const std::vector<std::uint32_t> order = packet_order(receivers);
  std::vector<std::uint32_t> visited;
  for_each_packet(receivers, order, [&](const ReceiverPacket& packet, std::span<const std::uint32_t> numbers) {
    ASSERT_EQ(packet.count, numbers.size());
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      EXPECT_EQ(packet.x[l], receivers[numbers[std::min(l, numbers.size() - 1)]].p_cell.x);
    visited.insert(visited.end(), numbers.begin(), numbers.end());
  });
  EXPECT_EQ(visited, order);
}

}  // namespace
}  // namespace farlod
