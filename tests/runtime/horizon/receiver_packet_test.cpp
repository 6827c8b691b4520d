// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/receiver_packet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "farlod/error.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr Point3f upwards{0.0F, 0.0F, 1.0F}, east{1.0F, 0.0F, 0.0F}, south{0.0F, -1.0F, 0.0F};

std::vector<Receiver> random_receivers(std::size_t count, const std::vector<Point3f>& normals) {
  RandomPlaces random;
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < count; ++n)
    receivers.push_back({n, random.place(50.0, -5.0, 60.0),
                         normals[static_cast<std::size_t>(random.between(0.0, 0.999 * static_cast<double>(normals.size())))]});
  return receivers;
}

std::vector<std::vector<Receiver>> packets_of(const std::vector<Receiver>& receivers) {
  std::vector<std::vector<Receiver>> packets;
  for_each_group(receivers, packet_order(receivers),
                 [&](std::span<const ReceiverPacket> group, std::span<const std::uint32_t> numbers) {
                   for (const ReceiverPacket& packet : group) {
                     packets.emplace_back();
                     for (const std::uint32_t n : numbers.first(packet.count)) packets.back().push_back(receivers[n]);
                     numbers = numbers.subspan(packet.count);
                     for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
                       EXPECT_EQ(packet.x[l], packets.back()[std::min(l, packet.count - 1)].p_cell.x);
                   }
                   EXPECT_TRUE(numbers.empty());
                 });
  return packets;
}

std::vector<Receiver> raster(int columns, int rows) {
  std::vector<Receiver> receivers;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      receivers.push_back({receivers.size(), {static_cast<float>(column), static_cast<float>(row), 1.5F}, upwards});
  return receivers;
}

/// All nearer to the first than this, along x, y and z.
bool lie_within(const std::vector<Receiver>& packet, float width_m) {
  return std::all_of(packet.begin(), packet.end(), [&](const Receiver& r) {
    const Point3f &p = r.p_cell, &q = packet[0].p_cell;
    return std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)}) < width_m;
  });
}

/// The judge: receiver by receiver.
void expect_bounds(const std::vector<Receiver>& receivers, bool has_plane) {
  std::vector<std::uint32_t> numbers(receivers.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  const PacketBounds b = bounds_of(ReceiverPacket(receivers, numbers));
  // Centre and half side are rounded: by as much as a coordinate of some 60 m
  constexpr float rounding_m = 64.0F * std::numeric_limits<float>::epsilon();
  float west = receivers[0].p_cell.x, east_end = west, south_end = receivers[0].p_cell.y, north = south_end, depth = 1e9F;
  float low_z = receivers[0].p_cell.z, high_z = low_z;
  for (const auto& [index, p, n] : receivers) {
    west = std::min(west, p.x);
    east_end = std::max(east_end, p.x);
    south_end = std::min(south_end, p.y);
    north = std::max(north, p.y);
    low_z = std::min(low_z, p.z);
    high_z = std::max(high_z, p.z);
    depth = std::min(depth, dot(n, p));
  }
  EXPECT_NEAR(b.box.x - b.box.half_x, west, rounding_m);
  EXPECT_NEAR(b.box.x + b.box.half_x, east_end, rounding_m);
  EXPECT_NEAR(b.box.y - b.box.half_y, south_end, rounding_m);
  EXPECT_NEAR(b.box.y + b.box.half_y, north, rounding_m);
  EXPECT_EQ(std::pair(b.box.low_z, b.box.high_z), std::pair(low_z, high_z));
  const Point3f normal = has_plane ? receivers[0].normal : Point3f{};
  EXPECT_EQ((Point3f{b.normal_x, b.normal_y, b.normal_z}), normal);
  EXPECT_NEAR(b.depth, has_plane ? depth : -1.0F, rounding_m);
}

TEST(PacketBounds, HoldAllReceivers) {
  for (std::size_t count = 1; count <= ReceiverPacket::lanes; ++count)
    for (const Point3f& normal : {upwards, east, south}) expect_bounds(random_receivers(count, {normal}), true);
}

TEST(PacketBounds, HaveAPlaneWhereAllLookTheSameWay) {
  for (std::size_t odd = 0; odd < ReceiverPacket::lanes; ++odd)
    for (const Point3f& other : {south, Point3f{0.999F, 0.0F, 0.0F}, Point3f{1.0F, 1e-3F, 0.0F}, Point3f{1.0F, 0.0F, 1e-3F}}) {
      std::vector<Receiver> receivers = random_receivers(ReceiverPacket::lanes, {east});
      receivers[odd].normal = other;
      expect_bounds(receivers, false);
    }
}

TEST(PacketBounds, HaveNoPlaneWhereAllLookDown) { expect_bounds(random_receivers(16, {{0.6F, 0.0F, -0.8F}}), false); }

TEST(PacketOrder, EachReceiverIsInOnePacket) {
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 500U}) {
    std::vector<std::size_t> seen;
    for (const auto& packet : packets_of(random_receivers(count, {upwards, east, south}))) {
      EXPECT_FALSE(packet.empty());
      EXPECT_LE(packet.size(), ReceiverPacket::lanes);
      for (const Receiver& r : packet) seen.push_back(r.index);
    }
    std::sort(seen.begin(), seen.end());
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(seen, all);
  }
}

TEST(PacketOrder, PacketsAreFullButForTheLast) {
  // A raster has no gaps
  EXPECT_EQ(packets_of(raster(23, 17)).size(), (23U * 17U + 15U) / 16U);
}

TEST(PacketOrder, ARasterComesInSquares) {
  const auto packets = packets_of(raster(16, 32));
  EXPECT_EQ(packets.size(), 32U);
  for (const auto& packet : packets) EXPECT_TRUE(lie_within(packet, 4.0F));
}

TEST(PacketOrder, OppositeWallsStayApart) {
  // Two sides of a house, 8 m apart, come in turn
  std::vector<Receiver> receivers;
  for (int n = 0; n < 60; ++n) {
    const Point3f p{static_cast<float>(2 * (n % 10)), 0.0F, static_cast<float>(2 * (n / 10))};
    receivers.push_back({receivers.size(), p, south});
    receivers.push_back({receivers.size(), {p.x, 8.0F, p.z}, {0.0F, 1.0F, 0.0F}});
  }
  for (const auto& packet : packets_of(receivers))
    for (const Receiver& r : packet) EXPECT_EQ(r.normal, packet[0].normal);
}

TEST(PacketOrder, AGapIsWorthAPacketMore) {
  std::vector<Receiver> receivers = raster(4, 5);
  for (Receiver r : raster(3, 4)) {
    r.p_cell.x += 40.0F;
    r.index += 20;
    receivers.push_back(r);
  }
  const auto packets = packets_of(receivers);
  EXPECT_EQ(packets.size(), 3U) << "two would be enough";
  for (const auto& packet : packets) EXPECT_TRUE(lie_within(packet, 6.0F));
}

TEST(PacketOrder, ARasterComesInGroupsThatAreSquaresToo) {
  const std::vector<Receiver> receivers = raster(64, 32);
  std::size_t groups = 0;
  for_each_group(receivers, packet_order(receivers),
                 [&](std::span<const ReceiverPacket> group, std::span<const std::uint32_t> numbers) {
                   EXPECT_EQ(group.size(), packets_in_group);
                   std::vector<Receiver> of_group;
                   for (const std::uint32_t n : numbers) of_group.push_back(receivers[n]);
                   EXPECT_TRUE(lie_within(of_group, 16.0F));
                   ++groups;
                 });
  EXPECT_EQ(groups, 8U);
}

TEST(PacketBounds, HoldThoseOfEachPacketOfAGroup) {
  constexpr float rounding_m = 1e-4F;
  RandomPlaces random;
  for (const std::vector<Point3f>& normals :
       {std::vector{upwards, upwards, upwards}, {south, south, south}, {upwards, south, upwards}}) {
    std::vector<PacketBounds> bounds;
    std::vector<Point3f> places;
    for (const Point3f& normal : normals) {
      const std::vector<Point3f> some{random.place(30.0, -5.0, 40.0), random.place(30.0, -5.0, 40.0)};
      places.insert(places.end(), some.begin(), some.end());
      bounds.push_back(bounds_of(packet_of(some, normal)));
    }
    const PacketBounds all = joined(bounds);
    for (const Point3f& p : places) {
      EXPECT_LE(std::abs(p.x - all.box.x), all.box.half_x + rounding_m);
      EXPECT_LE(std::abs(p.y - all.box.y), all.box.half_y + rounding_m);
      EXPECT_GE(p.z, all.box.low_z);
      EXPECT_LE(p.z, all.box.high_z);
      EXPECT_GE(all.normal_x * p.x + all.normal_y * p.y + all.normal_z * p.z, all.depth - rounding_m);
    }
    const Point3f normal{all.normal_x, all.normal_y, all.normal_z};
    EXPECT_EQ(normal, normals[0] == normals[1] ? normals[0] : (Point3f{}));
  }
}

TEST(PacketOrder, EndsWhenItIsAskedTo) {
  std::stop_source stop;
  EXPECT_EQ(packet_order(raster(100, 100), stop.get_token()).ends.size(), 625U);
  stop.request_stop();
  EXPECT_THROW((void)packet_order(raster(100, 100), stop.get_token()), Cancelled);
}

TEST(PacketOrder, ManyAtOnePlace) {
  const std::vector<Receiver> receivers(40, Receiver{0, {1.0F, 2.0F, 3.0F}, upwards});
  EXPECT_EQ(packets_of(receivers).size(), 3U);
}

}  // namespace
}  // namespace farlod
