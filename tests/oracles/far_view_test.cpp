// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/far_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "horizon/sky_partition.hpp"
#include "tests/oracles/distance_to_segment.hpp"
#include "tests/package/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/random_places.hpp"

// What a far map says is compared with each edge, direction by direction.

namespace farlod {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr Point3f middle{10.0F, 10.0F, 1.5F};

/// Directions in each of which the tests below look, steep ones and flat ones.
std::vector<Point3d> far_directions() { return SkyPartition(SkyWeight::solid_angle, 4000).directions(); }

Point3d toward(double azimuth_rad, double slope) { return {std::cos(azimuth_rad), std::sin(azimuth_rad), slope}; }

std::vector<FarVerdict> verdicts_of(const FarHorizon& map, const std::vector<Point3d>& directions, const Point3f& p_cell) {
  const FarView view(map, p_cell);
  std::vector<FarVerdict> verdicts;
  for (const Point3d& d : directions) verdicts.push_back(view.verdict(d));
  return verdicts;
}

/// A wall's edge around the middle of the cell, 30 m away, 20 m wide.
HorizonEdge edge_toward(double azimuth_rad, float height_m) {
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  const auto corner = [&](double ahead, double left) {
    return Point3f{static_cast<float>(10.0 + ahead * c - left * s), static_cast<float>(10.0 + ahead * s + left * c), height_m};
  };
  return {corner(30.0, -10.0), corner(30.0, 10.0)};
}

/// With ends at least `nearest_m` from the middle of the cell.
HorizonEdge edge_away(RandomPlaces& random, double nearest_m) {
  const auto from_middle = [](const Point3f& p) { return horizontal(Point3d{p.x, p.y, p.z} - Point3d{10.0, 10.0, 0.0}); };
  while (true) {
    const HorizonEdge e = random.edge(100.0, -20.0, 60.0);
    if (distance_to_segment(from_middle(e.a), from_middle(e.b)) > nearest_m) return e;
  }
}

TEST(FarView, WhatIsCertainIsTrueForRandomEdges) {
  RandomPlaces random;
  const std::vector<Point3d> looks = far_directions();
  std::array<std::size_t, 4> met{};
  for (int n = 0; n < 200; ++n) {
    std::vector<HorizonEdge> edges;
    for (int k = 0; k <= n % 4; ++k) edges.push_back(edge_away(random, 15.0));
    FarHorizonByHand far(edges);
    const Point3f p = random.place(10.0, 0.0, 30.0) + Point3f{10.0F, 10.0F, 0.0F};
    const std::vector<FarVerdict> verdicts = verdicts_of(far.map(), looks, p);
    for (std::size_t d = 0; d < looks.size(); ++d) {
      const bool blocked = looks[d].z / std::hypot(looks[d].x, looks[d].y) < far.horizon(p, looks[d]);
      ++met[static_cast<std::size_t>(verdicts[d])];
      const bool is_wrong = verdicts[d] == (blocked ? FarVerdict::free : FarVerdict::blocked);
      EXPECT_FALSE(is_wrong) << "town " << n << ", direction " << d;
    }
  }
  EXPECT_GT(met[static_cast<std::size_t>(FarVerdict::blocked)], 10000U);
  EXPECT_GT(met[static_cast<std::size_t>(FarVerdict::free)], 10000U);
  // A corner's rounding of half a millimetre, 5 m away or more, opens 2e-4 of a turn or of a slope: of 800,000 directions few
  EXPECT_LT(
      met[static_cast<std::size_t>(FarVerdict::estimated_free)] + met[static_cast<std::size_t>(FarVerdict::estimated_blocked)],
      looks.size() * 200 / 1000);
}

TEST(FarView, BelowAnEdgeIsBlockedAndAboveItIsFree) {
  // All around, so that edges pass the x axis on either side, and the y axis
  for (int k = 0; k < 64; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * k / 64, slope = 15.0 / 30.0;
    FarHorizonByHand far({edge_toward(azimuth, 16.5F)});
    const double half_width = std::atan(10.0 / 30.0);
    const std::vector<Point3d> looks{toward(azimuth, slope - 0.001),
                                     toward(azimuth, slope + 0.001),
                                     toward(azimuth + half_width - 0.001, 0.01),
                                     toward(azimuth - half_width + 0.001, 0.01),
                                     toward(azimuth + half_width + 0.001, 0.01),
                                     toward(azimuth - half_width - 0.001, 0.01),
                                     toward(azimuth + std::numbers::pi, 0.01)};
    const std::vector<FarVerdict> verdicts = verdicts_of(far.map(), looks, middle);
    EXPECT_EQ(verdicts, (std::vector<FarVerdict>{FarVerdict::blocked, FarVerdict::free, FarVerdict::blocked, FarVerdict::blocked,
                                                 FarVerdict::free, FarVerdict::free, FarVerdict::free}))
        << "azimuth " << k << "/64 of a turn";
  }
}

TEST(FarView, TheOrderOfTheEndsMeansNothing) {
  RandomPlaces random;
  for (int n = 0; n < 50; ++n) {
    const HorizonEdge e = edge_away(random, 15.0);
    FarHorizonByHand far({e}), turned({HorizonEdge{e.b, e.a}});
    EXPECT_EQ(verdicts_of(far.map(), far_directions(), middle), verdicts_of(turned.map(), far_directions(), middle));
  }
}

TEST(FarView, AnEdgeThatIsLookedAlongIsNeverCertainlyBlocked) {
  for (int k = 0; k < 16; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * k / 16;
    const auto at = [&](double ahead) {
      return Point3f{static_cast<float>(10.0 + ahead * std::cos(azimuth)), static_cast<float>(10.0 + ahead * std::sin(azimuth)),
                     16.5F};
    };
    FarHorizonByHand far({HorizonEdge{at(30.0), at(50.0)}});
    const std::vector<FarVerdict> verdicts =
        verdicts_of(far.map(), {toward(azimuth, 0.49), toward(azimuth, 0.51), toward(azimuth + 0.001, 0.1)}, middle);
    EXPECT_TRUE(verdicts[0] == FarVerdict::estimated_free || verdicts[0] == FarVerdict::estimated_blocked) << k;
    EXPECT_EQ(verdicts[1], FarVerdict::free) << k;
    EXPECT_EQ(verdicts[2], FarVerdict::free) << k;
  }
}

TEST(FarView, AnEdgeThatTouchesTheReceiverSettlesNothing) {
  FarHorizonByHand far({HorizonEdge{{10.0F, 10.0F, 16.5F}, {10.0F, 40.0F, 16.5F}}});
  for (const FarVerdict v : verdicts_of(far.map(), {toward(0.3, 5.0), toward(2.0, 0.1), toward(4.0, 0.1)}, middle))
    EXPECT_TRUE(v == FarVerdict::estimated_free || v == FarVerdict::estimated_blocked);
}

TEST(FarView, WhatLiesBelowTheReceiverHidesNothing) {
  FarHorizonByHand far({edge_toward(1.0, 1.0F)});
  for (const FarVerdict v : verdicts_of(far.map(), far_directions(), middle)) EXPECT_EQ(v, FarVerdict::free);
}

TEST(FarView, LowerBordersHideNothing) {
  HorizonEdge border = edge_toward(1.0, 16.5F);
  border.role = EdgeRole::underside;
  FarHorizonByHand far({border});
  for (const FarVerdict v : verdicts_of(far.map(), far_directions(), middle)) EXPECT_EQ(v, FarVerdict::free);
}

TEST(FarView, EdgesMatterInTheirPatchesAlone) {
  FarHorizonByHand far({edge_toward(1.0, 16.5F)});
  far.occluders()[0].layers = 2;
  const std::vector<Point3d> below{toward(1.0, 0.01)};
  EXPECT_EQ(verdicts_of(far.map(), below, middle)[0], FarVerdict::free);
  EXPECT_EQ(verdicts_of(far.map(), below, {10.0F, 10.0F, 12.0F})[0], FarVerdict::blocked);
  // Below the lowest level no patch says what may be left out
  EXPECT_EQ(verdicts_of(far.map(), below, {10.0F, 10.0F, -1.0F})[0], FarVerdict::blocked);
}

/// The same bounds in each bin of a patch.
void fill(FarHorizon& map, std::uint32_t patch, float lower, float estimate, float upper) {
  const auto row = [&](std::vector<float>& slopes, float slope) {
    std::fill_n(slopes.begin() + static_cast<std::ptrdiff_t>(patch) * map.bins.count, map.bins.count, slope);
  };
  row(map.low, lower);
  row(map.estimate, estimate);
  row(map.high, upper);
}

TEST(FarView, WhatIsNotNamedIsJudgedByItsBounds) {
  FarHorizonByHand far({});
  fill(far.map(), 0, 0.1F, 0.3F, 0.6F);
  fill(far.map(), 1, 0.0F, 0.3F, infinite);
  const std::vector<Point3d> looks{toward(1.0, 0.09), toward(1.0, 0.29), toward(1.0, 0.31), toward(1.0, 0.61)};
  EXPECT_EQ(verdicts_of(far.map(), looks, middle), (std::vector<FarVerdict>{FarVerdict::blocked, FarVerdict::estimated_blocked,
                                                                            FarVerdict::estimated_free, FarVerdict::free}));
  EXPECT_EQ(verdicts_of(far.map(), looks, {10.0F, 10.0F, 12.0F}),
            (std::vector<FarVerdict>{FarVerdict::estimated_blocked, FarVerdict::estimated_blocked, FarVerdict::estimated_free,
                                     FarVerdict::estimated_free}));
}

TEST(FarView, WhatIsLikelyChangesEvenlyBetweenTwoFloors) {
  FarHorizonByHand far({});
  fill(far.map(), 0, 0.0F, 0.4F, 1.0F);
  fill(far.map(), 1, 0.0F, 0.2F, 1.0F);
  // At a quarter of the way from 0 m to 10 m: 0.35
  const Point3f p{10.0F, 10.0F, 2.5F};
  EXPECT_EQ(verdicts_of(far.map(), {toward(1.0, 0.34), toward(1.0, 0.36)}, p),
            (std::vector<FarVerdict>{FarVerdict::estimated_blocked, FarVerdict::estimated_free}));
}

TEST(FarView, BelowTheLowestLevelNothingUnnamedIsCertain) {
  FarHorizonByHand far({});
  fill(far.map(), 0, 0.1F, 0.3F, 0.6F);
  EXPECT_EQ(verdicts_of(far.map(), {toward(1.0, 0.05), toward(1.0, 2.0)}, {10.0F, 10.0F, -0.5F}),
            (std::vector<FarVerdict>{FarVerdict::estimated_blocked, FarVerdict::estimated_free}));
}

TEST(DistanceToSegment, IsThatOfTheNearestPlace) {
  EXPECT_EQ(distance_to_segment({3.0, -10.0}, {3.0, 10.0}), 3.0);
  EXPECT_EQ(distance_to_segment({3.0, 4.0}, {30.0, 40.0}), 5.0);
  EXPECT_EQ(distance_to_segment({30.0, 40.0}, {3.0, 4.0}), 5.0);
  EXPECT_EQ(distance_to_segment({3.0, 4.0}, {3.0, 4.0}), 5.0) << "both ends in one place";
  EXPECT_EQ(distance_to_segment({-1.0, 0.0}, {2.0, 0.0}), 0.0);
}

TEST(ExplicitInPatch, BothBitsAreSet) {
  const ReceiverPatches patches(20.0, 2, {0.0F, 10.0F});
  const package::ExplicitOccluder occluder{0, 0b0101, 0b10};
  EXPECT_TRUE(is_explicit_in(occluder, patches, patches.number(0, 1)));
  EXPECT_TRUE(is_explicit_in(occluder, patches, patches.number(2, 1)));
  EXPECT_FALSE(is_explicit_in(occluder, patches, patches.number(1, 1)));
  EXPECT_FALSE(is_explicit_in(occluder, patches, patches.number(0, 0)));
}

}  // namespace
}  // namespace farlod
