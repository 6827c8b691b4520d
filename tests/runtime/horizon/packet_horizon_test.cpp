// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/packet_horizon.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "farlod/angle.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/kernels.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

std::vector<AzimuthSampling> some_rings() {
  return {AzimuthSampling::even(1, {}), AzimuthSampling::even(16, {}),
          AzimuthSampling::even(256, GridRotation(Angle::degrees(20.0))),
          DirectionSampling(SkyPartition(SkyWeight::cosine, 290).directions()).azimuths(),
          DirectionSampling(SkyPartition(SkyWeight::solid_angle, 1).directions()).azimuths()};
}

Point2d direction_at(const AzimuthSampling& ring, std::size_t k) { return {ring.cosine()[k], ring.sine()[k]}; }

float just_above(double slope) { return std::nextafter(static_cast<float>(slope), std::numeric_limits<float>::infinity()); }
float just_below(double slope) { return std::nextafter(static_cast<float>(slope), 0.0F); }

/// Whether the horizon of one receiver lies where the oracle says, at one azimuth.
testing::AssertionResult lies_in(const PacketHorizon& horizon, std::size_t lane, std::size_t k, const SlopeRange& range) {
  const auto is_below = [&](float slope) { return ((horizon.below(k, slope) >> lane) & 1U) != 0; };
  if (is_below(just_above(range.high)) && !is_below(just_below(range.low))) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "lane " << lane << ", azimuth " << k << ": not between " << range.low << " and "
                                     << range.high;
}

/// Draws edges for a packet on some samplings, and compares every slope with the oracle. Returns how many rise above the
/// horizontal.
std::size_t compare_with_oracle(const std::vector<HorizonEdge>& edges, const std::vector<Point3f>& eyes) {
  std::size_t raised = 0;
  for (const AzimuthSampling& ring : some_rings()) {
    PacketHorizon horizon(ring);
    horizon.raise(silhouettes_of(edges), packet_of(eyes));
    for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const SlopeRange range = expected_horizon(edges, eyes[std::min(lane, eyes.size() - 1)], direction_at(ring, k));
        EXPECT_TRUE(lies_in(horizon, lane, k, range));
        raised += range.low > 0.0 ? 1 : 0;
      }
  }
  return raised;
}

/// Receivers side by side, as on a raster.
std::vector<Point3f> eyes_in_a_row(const Point3f& first, std::size_t count) {
  std::vector<Point3f> eyes;
  for (std::size_t n = 0; n < count; ++n)
    eyes.push_back({first.x + static_cast<float>(n % 4), first.y + static_cast<float>(n / 4), first.z});
  return eyes;
}

TEST(PacketHorizon, EdgesAnywhere) {
  RandomPlaces random;
  std::size_t raised = 0;
  for (int n = 0; n < 40; ++n) {
    std::vector<HorizonEdge> edges;
    for (int e = 0; e < 20; ++e) edges.push_back(random.edge(60.0, -5.0, 40.0));
    raised += compare_with_oracle(edges, eyes_in_a_row(random.place(30.0, 0.0, 20.0), 16));
  }
  EXPECT_GT(raised, 10000U) << "the edges hide too little to tell";
}

TEST(PacketHorizon, OneEdgeAtATime) {
  RandomPlaces random;
  for (int n = 0; n < 300; ++n) {
    const HorizonEdge edge = random.edge(60.0, -5.0, 40.0);
    compare_with_oracle({edge}, eyes_in_a_row(random.place(30.0, 0.0, 20.0), 16));
  }
}

TEST(PacketHorizon, ReceiversThatSeeAnEdgeInVeryDifferentDirections) {
  RandomPlaces random;
  for (int n = 0; n < 100; ++n) {
    // All around the edge, some of them nearly below it
    const HorizonEdge edge = random.edge(8.0, 5.0, 40.0);
    std::vector<Point3f> eyes;
    for (int e = 0; e < 16; ++e) eyes.push_back(random.place(12.0, 0.0, 20.0));
    compare_with_oracle({edge}, eyes);
  }
}

TEST(PacketHorizon, EdgesAfarAreWhereTheyMoveToEvenly) {
  RandomPlaces random;
  std::size_t raised = 0;
  for (int n = 0; n < 300; ++n) {
    const Point3f aside = random.direction_at(0.0), along = random.direction_at(0.0);
    const float distance_m = random.between(60.0, 500.0), half_m = random.between(1.0, 100.0);
    const Point3f middle{distance_m * aside.x, distance_m * aside.y, 0.0F};
    const auto end = [&](float s) { return Point3f{middle.x + s * along.x, middle.y + s * along.y, random.between(3.0, 90.0)}; };
    const Point3f a = end(-half_m);
    raised += compare_with_oracle({{a, end(half_m)}}, eyes_in_a_row({0.0F, 0.0F, 1.5F}, 16));
  }
  EXPECT_GT(raised, 10000U) << "the edges hide too little to tell";
}

TEST(PacketHorizon, PartialPacketsRepeatTheirLastReceiver) {
  RandomPlaces random;
  for (const std::size_t count : {1U, 2U, 5U, 15U}) {
    std::vector<HorizonEdge> edges;
    for (int e = 0; e < 10; ++e) edges.push_back(random.edge(60.0, 0.0, 40.0));
    compare_with_oracle(edges, eyes_in_a_row(random.place(10.0, 0.0, 5.0), count));
  }
}

TEST(PacketHorizon, EdgesAcrossTheBeginningOfTheTurn) {
  RandomPlaces random;
  for (int n = 0; n < 100; ++n) {
    const float x = random.between(3.0, 50.0), z = random.between(2.0, 30.0);
    const float south = random.between(-30.0, -0.1);
    const HorizonEdge across{{x, south, z}, {x, random.between(0.1, 30.0), z}};
    // Some eyes see all of it on one side of azimuth 0
    compare_with_oracle({across}, eyes_in_a_row({0.0F, random.between(-40.0, 40.0), 1.5F}, 16));
  }
  // From end to end, on all of the turn but half: beside the eye, whichever way it runs
  compare_with_oracle({{{0.5F, -1000.0F, 9.0F}, {0.5F, 1000.0F, 9.0F}}}, eyes_in_a_row({0.0F, 0.0F, 1.5F}, 16));
  compare_with_oracle({{{-0.5F, 1000.0F, 9.0F}, {-0.5F, -1000.0F, 9.0F}}}, eyes_in_a_row({0.0F, 0.0F, 1.5F}, 16));
}

TEST(PacketHorizon, EdgesSeenEndOn) {
  RandomPlaces random;
  for (int n = 0; n < 200; ++n) {
    const Point3f eye = random.place(20.0, 0.0, 5.0), along = random.direction_at(0.0);
    const float begin = random.between(0.5, 10.0), length = random.between(1.0, 50.0), aside = random.between(-1e-3, 1e-3);
    const HorizonEdge edge{{eye.x + begin * along.x, eye.y + begin * along.y, 10.0F},
                           {eye.x + (begin + length) * along.x - aside * along.y,
                            eye.y + (begin + length) * along.y + aside * along.x, random.between(5.0, 20.0)}};
    compare_with_oracle({edge}, eyes_in_a_row(eye, 3));
  }
}

TEST(PacketHorizon, LookingAlongAnEdgeNothingIsSteeperThanItsNearEndCanBe) {
  RandomPlaces random;
  std::size_t raised = 0;
  for (int n = 0; n < 3000; ++n) {
    // In line, but for the rounding of the ends: the plane through eye and edge may be any
    const Point3f eye = random.place(50.0, 0.0, 5.0), along = random.direction_at(0.0);
    const float near_m = random.between(1.0, 50.0), far_m = near_m + random.between(0.1, 50.0),
                rise_m = random.between(1.0, 20.0);
    const auto end = [&](float s) { return Point3f{eye.x + s * along.x, eye.y + s * along.y, eye.z + rise_m}; };
    const AzimuthSampling ring = AzimuthSampling(std::vector{Point3d{along.x, along.y, 0.0}});
    PacketHorizon horizon(ring);
    horizon.raise(silhouettes_of(std::vector<HorizonEdge>{{end(near_m), end(far_m)}}), packet_of(std::vector{eye}));
    EXPECT_NE(horizon.below(0, 1.01F * rise_m / near_m), 0U) << n;
    raised += horizon.below(0, 1e-6F) == 0 ? 1 : 0;
  }
  EXPECT_GT(raised, 100U) << "no eye hits the edge";
}

TEST(PacketHorizon, EdgesRightBesideAnEye) {
  RandomPlaces random;
  for (int n = 0; n < 200; ++n) {
    const Point3f eye = random.place(20.0, 0.0, 5.0), along = random.direction_at(0.0);
    const float aside = random.between(-0.02, 0.02), back = random.between(0.01, 20.0), on = random.between(0.01, 20.0);
    const auto at = [&](float s, float z) {
      return Point3f{eye.x + s * along.x - aside * along.y, eye.y + s * along.y + aside * along.x, z};
    };
    const float back_z = random.between(5.1, 30.0);
    compare_with_oracle({{at(-back, back_z), at(on, random.between(5.1, 30.0))}}, eyes_in_a_row(eye, 2));
  }
}

TEST(PacketHorizon, AnEyeInLineWithAnEdgeSeesNothingOfIt) {
  const HorizonEdge edge{{3.0F, 4.0F, 10.0F}, {9.0F, 4.0F, 10.0F}};
  compare_with_oracle({edge}, {{3.0F, 4.0F, 1.5F}, {9.0F, 4.0F, 1.5F}, {2.0F, 4.0F, 1.5F}, {3.0F, 4.0F, 10.0F}});
}

TEST(PacketHorizon, RightBelowTheTopOfAWallTheHouseIsHiddenAndNotTheStreet) {
  // Whichever way the edge runs, the house is in the west
  const AdjacentSlopes house_left{0, AdjacentSlopes::straight_down}, house_right{AdjacentSlopes::straight_down, 0};
  const Point3f south{10.0F, -5.0F, 6.0F}, north{10.0F, 5.0F, 6.0F};
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  for (const HorizonEdge& edge : {HorizonEdge{south, north, house_left}, HorizonEdge{north, south, house_right}}) {
    PacketHorizon horizon(ring);
    horizon.raise(silhouettes_of(std::vector{edge}), packet_of(std::vector{Point3f{10.0F, 1.0F, 1.5F}}));
    for (std::size_t k = 0; k < ring.size(); ++k) {
      // As if the eye stood a millimetre in the street: 4.5 m up, that far away
      const float steep = 0.99F * 4.5F / 0.001F * -ring.cosine()[k];
      EXPECT_EQ(horizon.below(k, ring.cosine()[k] < 0.0F ? steep : 1e-6F), ring.cosine()[k] < 0.0F ? 0U : 0xFFFFU) << k;
    }
  }
}

TEST(PacketHorizon, WhatIsNotAboveTheEyeRaisesNothing) {
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  RandomPlaces random;
  PacketHorizon horizon(ring);
  std::vector<HorizonEdge> edges;
  for (int e = 0; e < 100; ++e) edges.push_back(random.edge(50.0, -40.0, 2.0));
  horizon.raise(silhouettes_of(edges), packet_of(eyes_in_a_row({0.0F, 0.0F, 2.0F}, 16)));
  EXPECT_EQ(horizon.exceeds(PacketHorizon(ring)), 0U);
}

TEST(PacketHorizon, ReceiversAtManyHeightsSeeWhatIsAboveEach) {
  RandomPlaces random;
  for (int n = 0; n < 50; ++n) {
    std::vector<Point3f> eyes;
    for (int e = 0; e < 16; ++e) eyes.push_back({random.between(0.0, 3.0), random.between(0.0, 3.0), random.between(0.0, 60.0)});
    compare_with_oracle({random.edge(40.0, 0.0, 60.0), random.edge(40.0, 0.0, 60.0)}, eyes);
  }
}

TEST(PacketHorizon, NeitherTheOrderOfEdgesNorOfTheirEndsMatters) {
  RandomPlaces random;
  const AzimuthSampling ring = AzimuthSampling::even(128, {});
  std::vector<HorizonEdge> edges;
  for (int e = 0; e < 30; ++e) edges.push_back(random.edge(60.0, 0.0, 40.0));
  const ReceiverPacket eyes = packet_of(eyes_in_a_row({0.0F, 0.0F, 1.5F}, 16));
  PacketHorizon forwards(ring), backwards(ring);
  forwards.raise(silhouettes_of(edges), eyes);
  std::reverse(edges.begin(), edges.end());
  backwards.raise(silhouettes_of(edges), eyes);
  EXPECT_EQ(forwards.exceeds(backwards) | backwards.exceeds(forwards), 0U);
}

TEST(PacketHorizon, RowsRaiseOneReceiverOrAll) {
  const AzimuthSampling ring = AzimuthSampling::even(32, {});
  const std::vector<float> row{0.5F, 2.0F};
  std::vector<std::uint32_t> bins(32);
  for (std::uint32_t k = 0; k < 32; ++k) bins[k] = k / 16;
  PacketHorizon one(ring), all(ring);
  one.raise(row, only(5), bins);
  all.raise(row, everybody, bins);
  EXPECT_EQ(one.exceeds(PacketHorizon(ring)), 1U << 5);
  EXPECT_EQ(all.exceeds(one), 0xFFFFU & ~(1U << 5));
  for (std::size_t k = 0; k < 32; ++k) {
    EXPECT_EQ(all.below(k, row[bins[k]]), 0U);
    EXPECT_EQ(all.below(k, just_above(row[bins[k]])), 0xFFFFU);
  }
  one.clear();
  EXPECT_EQ(one.exceeds(PacketHorizon(ring)), 0U);
}

TEST(PacketHorizon, RaisingNeverLowers) {
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  RandomPlaces random;
  const ReceiverPacket eyes = packet_of(eyes_in_a_row({0.0F, 0.0F, 1.5F}, 16));
  PacketHorizon horizon(ring);
  for (int n = 0; n < 50; ++n) {
    const PacketHorizon before = horizon;
    horizon.raise(silhouettes_of(std::vector{random.edge(60.0, 0.0, 30.0)}), eyes);
    EXPECT_EQ(before.exceeds(horizon), 0U);
  }
  EXPECT_NE(horizon.exceeds(PacketHorizon(ring)), 0U);
}

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
    edge_kernels().find_raising({edges.batches(), EdgeRole::grounded}, joined(bounds), slopes, ring.view(), RaisingAt::azimuths,
                                &bits);
    return bits & 0xFU;
  };
  EXPECT_EQ(raising({0}), 0b0001U);
  EXPECT_EQ(raising({1}), 0b0011U);
  EXPECT_EQ(raising({0, 1}), 0b0011U);
}

}  // namespace
}  // namespace farlod
