// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/packet_group.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "horizon/kernels.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr std::size_t azimuth_count = 96;

/// A street: most of its edges are hidden behind the nearest.
std::vector<HorizonEdge> street(RandomPlaces& random) {
  std::vector<HorizonEdge> edges;
  for (int n = 0; n < 700; ++n) {
    const Point3f a = random.place(n < 100 ? 40.0 : 300.0, 2.0, 30.0);
    edges.push_back({a, {a.x + random.between(-12.0, 12.0), a.y + random.between(-12.0, 12.0), a.z}});
  }
  return edges;
}

std::vector<ReceiverPacket> packets_near(const Point3f& middle, std::size_t count, RandomPlaces& random) {
  std::vector<ReceiverPacket> packets;
  for (std::size_t n = 0; n < count; ++n) {
    const float x = middle.x + random.between(-8.0, 8.0), y = middle.y + random.between(-8.0, 8.0);
    std::vector<Point3f> places;
    for (int l = 0; l < 16; ++l) places.push_back({x + static_cast<float>(l % 4), y + static_cast<float>(l / 4), middle.z});
    packets.push_back(packet_of(places));
  }
  return packets;
}

TEST(PacketGroup, RaisesHorizonsAsEachPacketAloneDoes) {
  RandomPlaces random;
  const AzimuthSampling ring = AzimuthSampling::even(azimuth_count, {});
  PacketGroup group(ring);
  for (const std::size_t count : {1U, 3U, 4U, 16U, 40U})
    for (int turn = 0; turn < 5; ++turn) {
      const SilhouetteEdges edges = silhouettes_of(street(random));
      const std::vector<ReceiverPacket> packets = packets_near(random.place(20.0, 0.0, 2.0), count, random);
      std::vector<PacketHorizon> together(count, PacketHorizon(ring)), alone = together;
      group.raise(edges, packets, together);
      for (std::size_t n = 0; n < count; ++n) {
        alone[n].raise(edges, packets[n]);
        EXPECT_EQ(std::memcmp(together[n].slopes(), alone[n].slopes(), azimuth_count * sizeof(PacketHorizon::Row)), 0) << n;
      }
    }
}

TEST(PacketGroup, AcceptsThatThereAreNoEdges) {
  RandomPlaces random;
  const AzimuthSampling ring = AzimuthSampling::even(azimuth_count, {});
  PacketGroup group(ring);
  std::vector<PacketHorizon> horizons(6, PacketHorizon(ring));
  group.raise(SilhouetteEdges(), packets_near({0.0F, 0.0F, 1.0F}, 6, random), horizons);
  for (const PacketHorizon& horizon : horizons) EXPECT_EQ(horizon.row(0)[0], 0.0F);
}

TEST(FindRaising, KeepsWhatSomePacketMaySee) {
  // A wall of 20 m all around, and towers behind it
  const AzimuthSampling ring = AzimuthSampling::even(azimuth_count, {});
  const ReceiverPacket west = packet_of(std::vector{Point3f{-5.0F, 0.0F, 0.0F}}),
                       east = packet_of(std::vector{Point3f{5.0F, 0.0F, 0.0F}});
  const std::vector<HorizonEdge> wall{{{-30.0F, -30.0F, 20.0F}, {30.0F, -30.0F, 20.0F}},
                                      {{30.0F, -30.0F, 20.0F}, {30.0F, 30.0F, 20.0F}},
                                      {{30.0F, 30.0F, 20.0F}, {-30.0F, 30.0F, 20.0F}},
                                      {{-30.0F, 30.0F, 20.0F}, {-30.0F, -30.0F, 20.0F}}};
  // From the west, the wall rises to 20/25 and the second tower to 70/95; from the east, to 20/35 and 70/105
  std::vector<HorizonEdge> towers;
  for (const float height_m : {500.0F, 70.0F, 50.0F, 30.0F})
    towers.push_back({{-100.0F, -5.0F, height_m}, {-100.0F, 5.0F, height_m}});
  std::vector<PacketHorizon> horizons(2, PacketHorizon(ring));
  horizons[0].raise(silhouettes_of(wall), west);
  horizons[1].raise(silhouettes_of(wall), east);
  const SilhouetteEdges edges = silhouettes_of(towers);
  const auto raising = [&](std::initializer_list<std::size_t> of) {
    std::vector<const float*> slopes;
    std::vector<PacketBounds> bounds;
    for (const std::size_t n : of) {
      slopes.push_back(horizons[n].slopes());
      bounds.push_back(bounds_of(n == 0 ? west : east));
    }
    std::uint16_t bits = 0;
    edge_kernels().find_raising({edges.batches(), EdgeRole::grounded}, joined(bounds), slopes, ring.view(), &bits);
    return bits & 0xFU;
  };
  EXPECT_EQ(raising({0}), 0b0001U);
  EXPECT_EQ(raising({1}), 0b0011U);
  EXPECT_EQ(raising({0, 1}), 0b0011U);
}

}  // namespace
}  // namespace farlod
