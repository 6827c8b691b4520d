// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "farlod/angle.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/gap_kernels.hpp"
#include "horizon/kernels.hpp"
#include "horizon/packet_horizon.hpp"
#include "tests/runtime/horizon/kernel_targets.hpp"
#include "tests/runtime/horizon/random_places.hpp"

// What is open in gaps and the choice of facing edges have no scalar version, but judges in double (gap_sections_test,
// silhouette_edges_test), which bound the rounding: between targets, too, not a bit may differ.

namespace farlod {
namespace {

class KernelsOfTargets : public testing::TestWithParam<KernelTarget> {};

TEST_P(KernelsOfTargets, OpenGapsAsOnTheBaseline) {
  const GapKernels& baseline = *runnable_kernels().back().gap;
  const AzimuthSampling azimuths = AzimuthSampling::even(96, GridRotation(Angle::degrees(20.0)));
  RandomPlaces random;
  OverhangFacets facets;
  for (int n = 0; n < 300; ++n) {
    const HorizonEdge side = random.edge(60.0, 2.0, 20.0);
    facets.add({side.a, side.b, random.edge(60.0, 2.0, 20.0).a});
  }
  ReceiverPacket packet;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) packet.add({0, {}, random.direction_at(random.between(-1.0, 1.0))});
  GapBlock block{};
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    block.eyes.set(l, packet, l, azimuths, l / 4);
    block.to[l] = random.between(0.3, 3.0);
  }
  GapBlock expected = block;
  std::vector<PacketHorizon::Row> room(2 * (facets.size() + 1));
  int open = 0;
  for (const bool is_solid : {false, true}) {
    GetParam().gap->find_open({facets.batches(), facets.boxes()}, is_solid, room.front().data(), block);
    baseline.find_open({facets.batches(), facets.boxes()}, is_solid, room.front().data(), expected);
    EXPECT_EQ(block.from, expected.from);
    EXPECT_EQ(block.to, expected.to);
    EXPECT_EQ(block.sky, expected.sky);
    EXPECT_EQ(block.is_split, expected.is_split);
    for (const float sky : block.sky) open += sky > 0.0F ? 1 : 0;
  }
  EXPECT_GT(open, 4) << "too few to tell";
  const WedgeShape wedge{0.06F, std::cos(0.06F), std::sin(0.06F), std::tan(0.06F), 1.0005F};
  WedgeGapBlock gaps{};
  gaps.eyes = block.eyes;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
    gaps.from[l] = 0.01F, gaps.to[l] = gaps.top[l] = 2.0F, gaps.below[l] = 1e-4F;
  WedgeGapBlock expected_gaps = gaps;
  std::vector<PacketHorizon::Row> more_room(4 * (ReceiverPacket::lanes * facets.batches().size() + 1));
  GetParam().wedge_gap->find_certain({facets.batches(), facets.boxes()}, wedge, false, more_room.front().data(), gaps);
  runnable_kernels().back().wedge_gap->find_certain({facets.batches(), facets.boxes()}, wedge, false, more_room.front().data(),
                                                    expected_gaps);
  EXPECT_EQ(gaps.open, expected_gaps.open);
  EXPECT_EQ(gaps.hidden, expected_gaps.hidden);
  EXPECT_EQ(gaps.most, expected_gaps.most);
  EXPECT_GT(*std::max_element(gaps.hidden.begin(), gaps.hidden.end()), 0.0F) << "too few to tell";
  LowestOfSectors lowest;
  std::vector<PacketHorizon::Row> slopes(azimuths.size());
  for (PacketHorizon::Row& row : slopes)
    for (float& slope : row) slope = random.between(0.0, 3.0);
  const float* const horizon = slopes.front().data();
  GetParam().gap->find_lowest({&horizon, 1}, azimuths.view(), RaisingAt::azimuths, lowest);
  std::vector<std::uint16_t> found(facets.batches().size()), expected_found(found.size());
  GetParam().gap->find_above({facets.batches(), facets.boxes()}, bounds_of(packet), lowest, found.data());
  baseline.find_above({facets.batches(), facets.boxes()}, bounds_of(packet), lowest, expected_found.data());
  EXPECT_EQ(found, expected_found);
  std::vector<std::int32_t> bins(found.size() * ReceiverPacket::lanes), expected_bins(bins.size());
  GetParam().gap->find_bins(facets.batches(), bounds_of(packet).box, found.data(), bins.data());
  baseline.find_bins(facets.batches(), bounds_of(packet).box, found.data(), expected_bins.data());
  EXPECT_EQ(bins, expected_bins);
}

TEST_P(KernelsOfTargets, HighestBordersAsOnTheBaseline) {
  const KernelTarget& baseline = runnable_kernels().back();
  RandomPlaces random;
  std::vector<HorizonEdge> edges;
  for (int n = 0; n < 400; ++n) edges.push_back(random.edge(60.0, 0.0, 40.0));
  const SilhouetteEdges silhouettes = silhouettes_of(edges);
  const SilhouetteEdges* const list = &silhouettes;
  const BorderEnds ends({&list, 1});
  const AzimuthSampling azimuths = AzimuthSampling::even(96, {});
  PacketHorizon horizon(azimuths, PacketHorizon::Edges::tracked);
  const ReceiverPacket packet = packet_of(std::vector{Point3f{1.0F, 2.0F, 3.0F}});
  horizon.raise(silhouettes, packet);
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < azimuths.size(); ++k) {
    const Point3f along = random.direction_at(0.0);
    const std::uint32_t wedge = azimuths.around({along.x, along.y}).before;
    const LookInWedge look{wedge, static_cast<std::uint32_t>(azimuths.size()), 1.0F, 2.0F, 3.0F, along.x, along.y, 0.1F};
    const auto highest = [&](const KernelTarget& target) {
      return target.wedge_end->find_highest(horizon.drawn().spans(), horizon.drawn().size(), ends.all(), look);
    };
    EXPECT_EQ(highest(GetParam()).slope, highest(baseline).slope);
    EXPECT_EQ(highest(GetParam()).number, highest(baseline).number);
    found += highest(baseline).number >= 0 ? 1 : 0;
  }
  EXPECT_GT(found, 80U) << "too few to tell";
}

TEST_P(KernelsOfTargets, FacingEdgesAsOnTheBaseline) {
  const KernelTarget& baseline = runnable_kernels().back();
  RandomPlaces random;
  SilhouetteEdges edges;
  for (int n = 0; n < 1600; ++n) {
    HorizonEdge e = random.edge(300.0, -5.0, 40.0);
    e.adjacent = {static_cast<std::int8_t>(random.between(-127.0, 127.0)),
                  static_cast<std::int8_t>(random.between(-127.0, 127.0))};
    edges.add(e);
  }
  std::vector<float> distances_m(1600), expected_m(1600);
  const CenteredBox box{3.0F, 4.0F, 10.0F, 20.0F, 1.5F, 9.0F};
  GetParam().edge->find_facing({edges.batches(), EdgeRole::grounded}, box, distances_m.data());
  baseline.edge->find_facing({edges.batches(), EdgeRole::grounded}, box, expected_m.data());
  EXPECT_EQ(distances_m, expected_m);
}

INSTANTIATE_TEST_SUITE_P(Targets, KernelsOfTargets, testing::ValuesIn(kernel_targets()), name_of_target);

}  // namespace
}  // namespace farlod
