// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/silhouette_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "horizon/packet_horizon.hpp"
#include "horizon/residual_horizon.hpp"
#include "package/horizon_edge.hpp"
#include "tests/oracles/distance_to_segment.hpp"
#include "tests/package/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/random_places.hpp"
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
    const AzimuthSampling ring = AzimuthSampling::even(64, {});
    for (const Receiver& r : receivers)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point2d u{ring.cosine()[k], ring.sine()[k]};
        EXPECT_GE(expected_horizon(facing, r.p_cell, u).high, expected_horizon(town.grounded(), r.p_cell, u).low)
            << "azimuth " << k;
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

// Which edges face receivers: the oracle is may_be_silhouette, in doubles.

Point3d exactly(const Point3f& p) { return {p.x, p.y, p.z}; }

bool is_kept_by_oracle(const HorizonEdge& e, const ReceiverBox& box) {
  return std::max(e.a.z, e.b.z) > box.low.z &&
         may_be_silhouette(exactly(e.a), exactly(e.b), e.adjacent, e.role, {{box.low.x, box.low.y}, {box.high.x, box.high.y}},
                           box.low.z, box.high.z);
}

/// Distances, or less than 0, for a whole number of batches. All edges have the role of the first.
std::vector<float> found(const std::vector<HorizonEdge>& edges, const ReceiverBox& box) {
  std::vector<SilhouetteEdges::Batch> batches(edges.size() / SilhouetteEdges::lanes);
  for (std::size_t n = 0; n < edges.size(); ++n) {
    SilhouetteEdges::Batch& batch = batches.at(n / SilhouetteEdges::lanes);
    const std::size_t lane = n % SilhouetteEdges::lanes;
    const auto& [a, b, r, role] = edges[n];
    EXPECT_EQ(role, edges.front().role);
    batch.ax[lane] = a.x, batch.ay[lane] = a.y, batch.az[lane] = a.z;
    batch.bx[lane] = b.x, batch.by[lane] = b.y, batch.bz[lane] = b.z;
    batch.left[lane] = static_cast<float>(AdjacentSlopes::slope(r.left)),
    batch.right[lane] = static_cast<float>(AdjacentSlopes::slope(r.right));
  }
  std::vector<float> distances_m(edges.size());
  const float x = 0.5F * (box.low.x + box.high.x), y = 0.5F * (box.low.y + box.high.y);
  edge_kernels().find_facing(
      {batches, edges.front().role},
      {x, y, std::max(box.high.x - x, x - box.low.x), std::max(box.high.y - y, y - box.low.y), box.low.z, box.high.z},
      distances_m.data());
  return distances_m;
}

class Edges {
 public:
  explicit Edges(EdgeRole role) : role_(role) {}

  /// Between `reach_m` around the eyes, with facets of all angles on both sides, walls among them.
  [[nodiscard]] HorizonEdge edge(double reach_m, double length_m) {
    const Point3f a = random_.place(reach_m, -10.0, 60.0), way = random_.place(length_m, -1.0, 1.0);
    const float climb = random_.between(-1.0, 1.0) < 0.0F ? 0.0F : random_.between(-length_m, length_m);
    return {a, {a.x + way.x, a.y + way.y, a.z + climb}, {rise(), rise()}, role_};
  }
  /// In line with a corner of the box: whether the eyes are on both sides is decided by less than the rounding of a place.
  [[nodiscard]] HorizonEdge aimed_edge(double reach_m, double length_m, const ReceiverBox& box) {
    HorizonEdge e = edge(reach_m, length_m);
    const Point2d way = Point2d{box.high.x, box.low.y} - Point2d{e.a.x, e.a.y};
    const double share = length_m / norm(way);
    e.b = {static_cast<float>(e.a.x + share * way.x), static_cast<float>(e.a.y + share * way.y), e.a.z};
    return e;
  }
  [[nodiscard]] ReceiverBox box() {
    const Point3f p = random_.place(40.0, -5.0, 40.0);
    return {p, {p.x + random_.between(0.0, 50.0), p.y + random_.between(0.0, 50.0), p.z + random_.between(0.0, 30.0)}};
  }

 private:
  [[nodiscard]] std::int8_t rise() {
    const std::int8_t wall = role_ == EdgeRole::underside ? AdjacentSlopes::straight_up : AdjacentSlopes::straight_down;
    return random_.between(-1.0, 1.0) < 0.0F ? wall : static_cast<std::int8_t>(random_.between(-127.0, 127.0));
  }
  EdgeRole role_;
  RandomPlaces random_;
};

struct Tally {
  std::size_t kept = 0, away = 0, in_excess = 0;
};
Tally compared(EdgeRole role, double reach_m, double length_m) {
  Edges random(role);
  Tally tally;
  for (int n = 0; n < 300; ++n) {
    const ReceiverBox box = random.box();
    std::vector<HorizonEdge> edges;
    for (int k = 0; k < 320; ++k) edges.push_back(random.edge(reach_m, length_m));
    const std::vector<float> distances_m = found(edges, box);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const bool wanted = is_kept_by_oracle(edges[k], box), kept = distances_m[k] >= 0.0F;
      EXPECT_TRUE(kept || !wanted) << "edge " << k << " of box " << n;
      (wanted ? tally.kept : tally.away) += 1;
      tally.in_excess += kept && !wanted ? 1 : 0;
    }
  }
  return tally;
}

class FacingEdges : public testing::TestWithParam<EdgeRole> {};
std::string name_of_role(const testing::TestParamInfo<EdgeRole>& info) {
  const std::array names{"Grounded", "Overhang", "Underside"};
  return names.at(static_cast<std::size_t>(info.param));
}
INSTANTIATE_TEST_SUITE_P(Roles, FacingEdges, testing::Values(EdgeRole::grounded, EdgeRole::overhang, EdgeRole::underside),
                         name_of_role);

TEST_P(FacingEdges, NoneIsLostThatMayBeASilhouette) {
  // Near and far ones, and so short that they are next to nothing but rounding
  for (const double reach_m : {30.0, 300.0, 20000.0})
    for (const double length_m : {0.001, 10.0, 100.0}) {
      const Tally tally = compared(GetParam(), reach_m, length_m);
      EXPECT_GT(tally.kept, 1000U);
      EXPECT_GT(tally.away, 1000U);
    }
}

TEST_P(FacingEdges, RoundingLosesNone) {
  Edges random(GetParam());
  std::size_t near_misses = 0;
  for (int n = 0; n < 300; ++n) {
    const ReceiverBox box = random.box();
    std::vector<HorizonEdge> edges;
    for (int k = 0; k < 320; ++k) edges.push_back(random.aimed_edge(20000.0, 10.0, box));
    const std::vector<float> distances_m = found(edges, box);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      EXPECT_TRUE(distances_m[k] >= 0.0F || !is_kept_by_oracle(edges[k], box)) << "edge " << k << " of box " << n;
      near_misses += is_kept_by_oracle(edges[k], box) ? 0 : 1;
    }
  }
  EXPECT_GT(near_misses, 1000U) << "all are kept anyway";
}

TEST_P(FacingEdges, RoundingKeepsFewInExcess) {
  // It decides about who is within millimetres of a plane, of edges tens of metres away
  const Tally tally = compared(GetParam(), 300.0, 30.0);
  EXPECT_LT(1000 * tally.in_excess, tally.away);
}

TEST(FacingEdgesOneByOne, UprightAndBelow) {
  const HorizonEdge upright{{10.0F, 0.0F, 0.0F}, {10.0F, 0.0F, 9.0F}, {0, 0}}, low{{10.0F, 0.0F, 1.0F}, {10.0F, 9.0F, 1.0F}};
  std::vector<HorizonEdge> edges(SilhouetteEdges::lanes, low);
  edges[3] = upright;
  const std::vector<float> distances_m = found(edges, {{0.0F, 0.0F, 1.0F}, {2.0F, 0.0F, 5.0F}});
  for (std::size_t n = 0; n < edges.size(); ++n) EXPECT_EQ(distances_m[n], n == 3 ? 9.0F : -1.0F);
}

TEST(FacingEdgesOneByOne, DistancesAreFromTheMiddle) {
  RandomPlaces random;
  std::vector<HorizonEdge> edges;
  for (int n = 0; n < 160; ++n) edges.push_back(random.edge(100.0, 5.0, 30.0));
  const std::vector<float> distances_m = found(edges, {{-1.0F, -5.0F, 0.0F}, {3.0F, 7.0F, 1.0F}});
  const Point2d middle{1.0, 1.0};
  // A coordinate of up to 101 m is rounded at each of ten steps, and the way along an edge of up to 283 m
  constexpr double rounding_m = (10.0 * 101.0 + 3.0 * 283.0) * float_rounding;
  for (std::size_t n = 0; n < edges.size(); ++n)
    EXPECT_NEAR(distances_m[n],
                distance_to_segment(horizontal(exactly(edges[n].a)) - middle, horizontal(exactly(edges[n].b)) - middle),
                rounding_m);
}

/// Two floors, at 0 and 10 m: slopes differ from floor to floor, and from bin to bin.
class TwoFloors : public testing::Test {
 protected:
  TwoFloors() {
    FarHorizon& map = far_.map();
    for (std::size_t n = 0; n < map.estimate.size(); ++n) {
      map.low[n] = 0.2F * slope_of(n);
      map.estimate[n] = slope_of(n);
      map.high[n] = 2.0F * slope_of(n);
      map.overhang[n] = 0.5F * slope_of(n);
    }
  }
  [[nodiscard]] float slope_of(std::size_t row) const { return (row < 8 ? 1.0F : 0.75F) + 0.0625F * static_cast<float>(row % 8); }

  using Raise = void (ResidualHorizon::*)(const ReceiverPacket&, PacketHorizon&) const;
  /// Whether the horizon of each receiver, once raised, lies at slope_at(place, bin), within a few roundings.
  template <class SlopeAt>
  void expect_slopes(const std::vector<Point3f>& places, Raise raise, const SlopeAt& slope_at) {
    PacketHorizon horizon(ring_);
    (ResidualHorizon(far_.map(), ring_).*raise)(packet_of(places), horizon);
    constexpr auto rounding = static_cast<float>(8.0 * float_rounding);
    for (std::size_t l = 0; l < places.size(); ++l)
      for (std::size_t k = 0; k < ring_.size(); ++k) {
        const float slope = slope_at(places[l], far_.map().bins.bin_of({ring_.cosine()[k], ring_.sine()[k]}));
        EXPECT_EQ((horizon.below(k, slope * (1.0F - rounding)) >> l) & 1U, 0U) << places[l].z << " m, azimuth " << k;
        EXPECT_EQ((horizon.below(k, slope * (1.0F + rounding) + rounding) >> l) & 1U, std::isinf(slope) ? 0U : 1U) << places[l].z;
      }
  }
  static std::vector<Point3f> at_heights(const std::vector<float>& heights_m) {
    std::vector<Point3f> places;
    for (const float z : heights_m) places.push_back({3.0F, 3.0F, z});
    return places;
  }

  FarHorizonByHand far_{{}};
  const AzimuthSampling ring_ = AzimuthSampling::even(40, {});
  const std::vector<std::vector<float>> alike_and_not_{{2.5F},  {2.5F, 2.5F, 2.5F},          {1.0F, 9.0F, 3.0F},
                                                       {-2.0F}, {0.0F, 10.0F, 50.0F, -1.0F}, {9.9F, 10.1F}};
};

TEST_F(TwoFloors, TheEstimateChangesEvenlyBetweenThem) {
  for (const auto& heights_m : alike_and_not_)
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_estimate, [this](const Point3f& p, std::uint32_t bin) {
      const float share = std::clamp(p.z / 10.0F, 0.0F, 1.0F);
      return slope_of(bin) + share * (slope_of(8 + bin) - slope_of(bin));
    });
}

TEST_F(TwoFloors, BoundsHoldForAFloor) {
  for (const auto& heights_m : alike_and_not_) {
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_low, [this](const Point3f& p, std::uint32_t bin) {
      return p.z < 0.0F ? 0.0F : 0.2F * slope_of(p.z < 10.0F ? bin : 8 + bin);
    });
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_high, [this](const Point3f& p, std::uint32_t bin) {
      return p.z < 0.0F ? std::numeric_limits<float>::infinity() : 2.0F * slope_of(p.z < 10.0F ? bin : 8 + bin);
    });
  }
}

TEST_F(TwoFloors, LowerBordersRiseToWhatHoldsForAFloor) {
  for (const auto& heights_m : alike_and_not_)
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_overhang, [this](const Point3f& p, std::uint32_t bin) {
      return p.z < 0.0F ? std::numeric_limits<float>::infinity() : 0.5F * slope_of(p.z < 10.0F ? bin : 8 + bin);
    });
}

TEST_F(TwoFloors, WhereNothingOverhangsNoBorderRises) {
  std::fill(far_.map().overhang.begin(), far_.map().overhang.end(), 0.0F);
  for (const auto& heights_m : alike_and_not_)
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_overhang, [](const Point3f&, std::uint32_t) { return 0.0F; });
}

TEST_F(TwoFloors, TheEstimateStaysBetweenTheBounds) {
  std::fill(far_.map().estimate.begin(), far_.map().estimate.begin() + 8, 9.0F);
  std::fill(far_.map().estimate.begin() + 8, far_.map().estimate.end(), 0.0F);
  expect_slopes(at_heights({1.0F, 2.0F}), &ResidualHorizon::raise_to_estimate,
                [this](const Point3f&, std::uint32_t bin) { return 2.0F * slope_of(bin); });
  expect_slopes(at_heights({12.0F}), &ResidualHorizon::raise_to_estimate,
                [this](const Point3f&, std::uint32_t bin) { return 0.2F * slope_of(8 + bin); });
}

}  // namespace
}  // namespace farlod
