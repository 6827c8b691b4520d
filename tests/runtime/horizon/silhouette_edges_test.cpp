// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/silhouette_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "horizon/packet_horizon.hpp"
#include "tests/oracles/distance_to_segment.hpp"
#include "tests/runtime/horizon/horizon_judge.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

namespace farlod {
namespace {

TEST(SilhouetteEdges, GiveBackWhatWasAdded) {
  SilhouetteEdges edges;
  EXPECT_TRUE(edges.empty());
  const HorizonEdge e{{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, {7, -8}}, f{{9.0F, 8.0F, 7.0F}, {6.0F, 5.0F, 4.0F}};
  edges.add(e);
  edges.add(f);
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_EQ(edges.at(0), e);
  EXPECT_EQ(edges.at(1), f);
}

std::vector<HorizonEdge> all_of(const SilhouetteEdges& edges) {
  std::vector<HorizonEdge> result;
  for (std::size_t n = 0; n < edges.size(); ++n) result.push_back(edges.at(n));
  return result;
}

/// From everywhere in a box, the edges that do not face away from it make the same horizon as all of them.
TEST(SilhouetteEdges, ThoseThatFaceAwayHideNothing) {
  RandomPlaces random;
  std::size_t all = 0, kept = 0;
  for (int n = 0; n < 20; ++n) {
    TownByHand town;
    add_random_boxes(random, 15, town);
    const std::vector<Receiver> receivers = receivers_in_a_square(random, {0.0F, 0.0F, 1.0F});
    ReceiverBox box{receivers[0].p_cell, receivers[0].p_cell};
    for (const Receiver& r : receivers) {
      box.low = {std::min(box.low.x, r.p_cell.x), std::min(box.low.y, r.p_cell.y), std::min(box.low.z, r.p_cell.z)};
      box.high = {std::max(box.high.x, r.p_cell.x), std::max(box.high.y, r.p_cell.y), std::max(box.high.z, r.p_cell.z)};
    }
    const std::vector<HorizonEdge> facing = all_of(town.silhouettes().grounded.facing(box));
    all += town.grounded().size();
    kept += facing.size();
    const AzimuthRing ring = AzimuthRing::even(64, {});
    for (const Receiver& r : receivers)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point2d u{ring.cosine()[k], ring.sine()[k]};
        EXPECT_GE(judged_horizon(facing, r.p_cell, u).high, judged_horizon(town.grounded(), r.p_cell, u).low) << "azimuth " << k;
      }
  }
  EXPECT_LT(kept, all * 3 / 4) << "too few are left out to tell";
}

/// An eave 4.5 m above the eyes and 10 m off, with a roof that rises behind it.
std::size_t eaves_kept(double roof_deg) {
  SilhouetteEdges edges;
  const std::int8_t roof = AdjacentSlopes::rounded_down(roof_deg / 180.0 * std::numbers::pi);
  edges.add({{10.0F, -5.0F, 6.0F}, {10.0F, 5.0F, 6.0F}, {AdjacentSlopes::straight_down, roof}});
  return edges.facing({{-1.0F, -1.0F, 1.5F}, {0.0F, 1.0F, 1.5F}}).size();
}

TEST(SilhouetteEdges, AnEaveUnderASteeperRoofIsNoHorizon) {
  // The eave is seen at 22° to 24°
  EXPECT_EQ(eaves_kept(45.0), 0U);
  EXPECT_EQ(eaves_kept(26.0), 0U);
  EXPECT_EQ(eaves_kept(20.0), 1U);
  EXPECT_EQ(eaves_kept(-30.0), 1U);
}

TEST(SilhouetteEdges, ComeFromNearToFar) {
  RandomPlaces random;
  SilhouetteEdges edges;
  // From the next metre to beyond all steps
  for (const double reach_m : {1.5, 15.0, 90.0, 2000.0, 500000.0})
    for (int n = 0; n < 100; ++n) edges.add(random.edge(reach_m, 5.0, 30.0));
  const std::vector<HorizonEdge> ordered = all_of(edges.facing({{-1.0F, -1.0F, 1.0F}, {1.0F, 1.0F, 2.0F}}));
  EXPECT_EQ(ordered.size(), 500U);
  constexpr double nearest_step_m = 0.25, farthest_step_m = 131072.0, step = 1.0 + 1.0 / 32;
  const auto distance = [&](const HorizonEdge& e) {
    return std::clamp(distance_to_segment({e.a.x, e.a.y}, {e.b.x, e.b.y}), nearest_step_m, farthest_step_m / step);
  };
  for (std::size_t n = 1; n < ordered.size(); ++n)
    EXPECT_GE(distance(ordered[n]) * step, distance(ordered[n - 1]) * (1.0 - 10.0 * float_rounding));
}

TEST(SilhouetteEdges, ThoseOfOneDistanceStayInOrder) {
  SilhouetteEdges edges;
  for (int n = 0; n < 40; ++n) edges.add({{10.0F, -5.0F, 8.0F + static_cast<float>(n)}, {10.0F, 5.0F, 8.0F}});
  const std::vector<HorizonEdge> ordered = all_of(edges.facing({{0.0F, 0.0F, 0.0F}, {5.0F, 5.0F, 2.0F}}));
  EXPECT_EQ(ordered, all_of(edges));
}

TEST(SilhouetteEdges, WallsAreToTheRight) {
  SilhouetteEdges edges;
  edges.add({{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, {AdjacentSlopes::straight_down, -8}});
  edges.add({{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, {-8, AdjacentSlopes::straight_down}});
  EXPECT_EQ(edges.at(0), (HorizonEdge{{4.0F, 5.0F, 6.0F}, {1.0F, 2.0F, 3.0F}, {-8, AdjacentSlopes::straight_down}}));
  EXPECT_EQ(edges.at(1), (HorizonEdge{{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, {-8, AdjacentSlopes::straight_down}}));
}

TEST(SilhouetteEdges, WallsWithoutThicknessFaceBothWays) {
  SilhouetteEdges edges;
  edges.add({{10.0F, -5.0F, 8.0F}, {10.0F, 5.0F, 8.0F}});
  EXPECT_EQ(edges.facing({{0.0F, 0.0F, 0.0F}, {5.0F, 5.0F, 2.0F}}).size(), 1U);
  EXPECT_EQ(edges.facing({{15.0F, 0.0F, 0.0F}, {20.0F, 5.0F, 2.0F}}).size(), 1U);
}

}  // namespace
}  // namespace farlod
