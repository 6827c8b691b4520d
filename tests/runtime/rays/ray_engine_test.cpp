// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "rays/ray_engine.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "evaluate/visibility.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/package/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/grazing_rays.hpp"
#include "tests/runtime/horizon/packed_overhangs.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

// Most rays are told from horizons, some below lower borders are traced: together they must give what rays against all of it
// give.

namespace farlod {
namespace {

constexpr std::size_t ray_count = 500;

struct Setting {
  const char* name;
  int boxes, overhangs;
};
void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.name; }

std::array<std::uint32_t, 3> interval(const FreeRays& free) { return {free.low, free.estimate, free.high}; }

class RayEngineInTown : public testing::TestWithParam<Setting> {
 protected:
  RayEngineInTown() {
    add_random_boxes(random_, GetParam().boxes, town_);
    add_random_overhangs(random_, GetParam().overhangs, town_);
  }
  RandomPlaces random_;
  TownByHand town_;
  FarHorizonByHand far_{{}};
};

TEST_P(RayEngineInTown, CountsWhatTheWholeSceneLeavesFree) {
  const Occluder city = town_.city();
  const PackedOverhangs packed(town_.overhanging());
  OverhangGeometry overhangs = packed.geometry();
  const DirectionSampling sampling(SkyPartition(SkyWeight::cosine, ray_count).directions());
  RayEngine engine(sampling, far_.map(), town_.silhouettes(), overhangs, true),
      without_bounds(sampling, far_.map(), town_.silhouettes(), overhangs, false);
  std::uint32_t grazing = 0, hidden = 0, through_gaps = 0;
  constexpr int packets = 30;
  for (int n = 0; n < packets; ++n) {
    const std::vector<Receiver> receivers = receivers_in_a_square(random_, {0.0F, 0.0F, 1.0F});
    const std::vector<FreeRays> free = engine.count(receivers), plain = without_bounds.count(receivers);
    for (std::size_t l = 0; l < receivers.size(); ++l) {
      std::uint32_t surely_free = 0, perhaps_free = 0;
      for (std::size_t k = 0; k < sampling.size(); ++k) {
        const RayVerdict ray = verdict(city, receivers[l].p_cell, sampling.direction(k));
        surely_free += ray.is_free && !ray.grazes ? 1 : 0;
        perhaps_free += ray.is_free || ray.grazes ? 1 : 0;
      }
      EXPECT_GE(free[l].estimate, surely_free) << n << ", receiver " << l;
      EXPECT_LE(free[l].estimate, perhaps_free) << n << ", receiver " << l;
      // Through a gap something that is not near may still be met
      if (GetParam().overhangs == 0) {
        EXPECT_EQ(free[l].low, free[l].estimate) << "nothing is residual";
      }
      EXPECT_LE(free[l].low, free[l].estimate);
      EXPECT_THAT(interval(plain[l]), testing::Each(free[l].estimate));
      through_gaps += free[l].estimate - free[l].low;
      EXPECT_EQ(free[l].high, free[l].estimate) << "nothing is residual";
      grazing += perhaps_free - surely_free;
      hidden += static_cast<std::uint32_t>(ray_count) - perhaps_free;
    }
  }
  // A border of the sky of 8π on the unit disk, and twice the angle wide: this share of the rays may graze it, at the most
  EXPECT_LE(grazing, 2.0 * static_cast<double>(grazing_rad) * 8.0 * packets * ReceiverPacket::lanes * ray_count);
  EXPECT_EQ(through_gaps > 1000, GetParam().overhangs > 0) << through_gaps;
  EXPECT_GT(hidden, packets * ReceiverPacket::lanes * ray_count / 20) << "the town hides too little to tell";
}

INSTANTIATE_TEST_SUITE_P(Towns, RayEngineInTown,
                         testing::Values(Setting{"Grounded", 50, 0}, Setting{"Overhanging", 0, 25}, Setting{"Both", 30, 15}),
                         [](const auto& test) { return test.param.name; });

TEST(RayEngine, AnEmptyTownHidesNothing) {
  const TownByHand empty;
  FarHorizonByHand far({});
  const PackedOverhangs packed(empty.overhanging());
  OverhangGeometry overhangs = packed.geometry();
  const DirectionSampling sampling(SkyPartition(SkyWeight::solid_angle, 145).directions());
  RayEngine engine(sampling, far.map(), empty.silhouettes(), overhangs, true);
  const std::vector<Receiver> receivers{{0, {3.0F, 3.0F, 1.5F}}, {1, {4.0F, 3.0F, 1.5F}}};
  for (const FreeRays& free : engine.count(receivers)) EXPECT_THAT(interval(free), testing::Each(145U));
}

// A wall to the east is near, on the ground or floating; one to the west is far, once explicit, once residual.

constexpr float near_x = 25.0F, far_x = -40.0F, south = -50.0F, north = 70.0F, top = 30.0F, gap = 6.0F;

using Corners = std::array<Point3f, 3>;

std::array<Corners, 2> wall_at(float x, float foot) {
  const Point3f a{x, south, foot}, b{x, north, foot}, c{x, north, top}, d{x, south, top};
  return {{{a, b, c}, {a, c, d}}};
}

struct Walls {
  const char* name;
  bool near_floats, far_is_explicit;
  [[nodiscard]] float near_foot() const { return near_floats ? gap : 0.0F; }
};
void PrintTo(const Walls& walls, std::ostream* out) { *out << walls.name; }

Occluder both_walls(const Walls& walls) {
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  for (const auto& wall : {wall_at(near_x, walls.near_foot()), wall_at(far_x, 0.0F)})
    for (const Corners& t : wall) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(), t.begin(), t.end());
      triangles.push_back({first, first + 1, first + 2});
    }
  return {vertices, triangles};
}

CellSilhouettes silhouettes_of(const Walls& walls) {
  CellSilhouettes silhouettes;
  const HorizonEdge near_top{{near_x, south, top}, {near_x, north, top}};
  (walls.near_floats ? silhouettes.near.overhangs : silhouettes.grounded).add(near_top);
  if (walls.near_floats) {
    constexpr AdjacentSlopes nothing_beside{AdjacentSlopes::straight_up, AdjacentSlopes::straight_up};
    silhouettes.near.undersides.add({{near_x, south, gap}, {near_x, north, gap}, nothing_beside, EdgeRole::underside});
  }
  if (walls.far_is_explicit) silhouettes.grounded.add({{far_x, south, top}, {far_x, north, top}});
  return silhouettes;
}

class TwoWalls : public testing::TestWithParam<Walls> {
 protected:
  TwoWalls() {
    // Residual, the wall may hide all below 45° anywhere, and surely hides nothing
    std::fill(far_.map().high.begin(), far_.map().high.end(), 1.0F);
    std::fill(far_.map().estimate.begin(), far_.map().estimate.end(), 0.4F);
    for (std::size_t n = 0; n < 16; ++n) {
      receivers_.push_back({n, {1.0F + 1.2F * static_cast<float>(n), 7.0F, 1.5F}});
      places_.push_back(receivers_.back().p_cell);
    }
  }
  [[nodiscard]] std::vector<std::uint32_t> exact() const { return count_free(city_, places_, directions_); }

  const Occluder city_ = both_walls(GetParam());
  const std::vector<Point3d> directions_ = SkyPartition(SkyWeight::cosine, 1000).directions();
  const DirectionSampling sampling_{directions_};
  const CellSilhouettes silhouettes_ = silhouettes_of(GetParam());
  const PackedOverhangs packed_{GetParam().near_floats ? wall_at(near_x, gap) : std::array<Corners, 2>{}};
  OverhangGeometry overhangs_ = packed_.geometry();
  FarHorizonByHand far_{{}};
  RayEngine engine_{sampling_, far_.map(), silhouettes_, overhangs_, true};
  std::vector<Receiver> receivers_;
  std::vector<Point3f> places_;
};

TEST_P(TwoWalls, TheExactCountLiesWithinTheBounds) {
  const std::vector<FreeRays> free = engine_.count(receivers_);
  const std::vector<std::uint32_t> truth = exact();
  std::uint32_t open = 0;
  for (std::size_t n = 0; n < free.size(); ++n) {
    EXPECT_LE(free[n].low, free[n].estimate);
    EXPECT_LE(free[n].estimate, free[n].high);
    EXPECT_LE(free[n].low, truth[n]);
    EXPECT_GE(free[n].high, truth[n]);
    open += free[n].high - free[n].low;
  }
  EXPECT_GT(open, 0U) << "nothing is left open to tell";
}

TEST_P(TwoWalls, AStopEndsCounting) {
  std::stop_source stop;
  RayEngine engine(sampling_, far_.map(), silhouettes_, overhangs_, true, stop.get_token());
  EXPECT_EQ(engine.count(receivers_).size(), receivers_.size());
  stop.request_stop();
  EXPECT_THROW((void)engine.count(receivers_), Cancelled);
}

TEST_P(TwoWalls, WithoutBoundsTheEstimateIsTheSame) {
  RayEngine without(sampling_, far_.map(), silhouettes_, overhangs_, false);
  const std::vector<FreeRays> bounded = engine_.count(receivers_), plain = without.count(receivers_);
  for (std::size_t n = 0; n < receivers_.size(); ++n) EXPECT_THAT(interval(plain[n]), testing::Each(bounded[n].estimate)) << n;
}

TEST_P(TwoWalls, APacketDoesNotRememberTheOneBefore) {
  const std::vector<FreeRays> all = engine_.count(receivers_);
  const std::vector<FreeRays> some = engine_.count(std::span(receivers_).subspan(3, 5));
  ASSERT_EQ(some.size(), 5U);
  for (std::size_t n = 0; n < some.size(); ++n) EXPECT_EQ(interval(some[n]), interval(all[n + 3]));
}

TEST_P(TwoWalls, ReceiversAtDifferentHeightsSeeEachAtItsOwn) {
  for (std::size_t n = 0; n < receivers_.size(); ++n) receivers_[n].p_cell.z = 1.5F + 1.5F * static_cast<float>(n);
  const std::vector<FreeRays> together = engine_.count(receivers_);
  for (std::size_t n = 0; n < receivers_.size(); ++n) {
    const std::vector<FreeRays> alone = engine_.count(std::span(receivers_).subspan(n, 1));
    EXPECT_EQ(interval(together[n]), interval(alone[0])) << n;
  }
  EXPECT_LT(together.front().estimate, together.back().estimate) << "the higher, the more sky";
}

INSTANTIATE_TEST_SUITE_P(RayEngine, TwoWalls,
                         testing::Values(Walls{"GroundedAndResidual", false, false}, Walls{"GroundedAndExplicit", false, true},
                                         Walls{"FloatingAndResidual", true, false}, Walls{"FloatingAndExplicit", true, true}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlod
