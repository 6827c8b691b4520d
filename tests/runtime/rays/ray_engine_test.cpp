// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "rays/ray_engine.hpp"

#include <gtest/gtest.h>

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
      EXPECT_EQ(plain[l].low, free[l].estimate);
      EXPECT_EQ(plain[l].estimate, free[l].estimate);
      EXPECT_EQ(plain[l].high, free[l].estimate);
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
  for (const FreeRays& free : engine.count(receivers)) {
    EXPECT_EQ(free.low, 145U);
    EXPECT_EQ(free.high, 145U);
  }
}

}  // namespace
}  // namespace farlod
