// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/ray_engine.hpp"

#include <gtest/gtest.h>

#include "farlod/sky/sky_partition.hpp"
#include "tests/contract/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/grazing_rays.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

// What stands is told from horizons, what hangs from rays: together they must give what rays against all of it give.

namespace farlod {
namespace {

constexpr std::size_t ray_count = 500;

struct Setting {
  const char* name;
  int boxes, slabs;
};
void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.name; }

class RayEngineInTown : public testing::TestWithParam<Setting> {
 protected:
  RayEngineInTown() {
    add_random_boxes(random_, GetParam().boxes, town_);
    for (int n = 0; n < GetParam().slabs; ++n) {
      const Point2d low{random_.between(-20.0, 30.0), random_.between(-20.0, 30.0)};
      const Point2d size{random_.between(1.0, 9.0), random_.between(1.0, 9.0)};
      town_.add_slab(low, size, random_.between(7.0, 15.0));
    }
  }
  RandomPlaces random_;
  TownByHand town_;
  FarHorizonByHand far_{{}};
};

TEST_P(RayEngineInTown, CountsWhatTheWholeSceneLeavesFree) {
  const Occluder city = town_.city();
  const HangingCity hanging(town_.skyline().hanging);
  const Occluder scene = hanging.scene();
  const RayFan fan(SkyPartition(SkyWeight::cosine, ray_count).directions());
  RayEngine engine(fan, far_.map(), town_.skyline(), hanging, scene, true);
  std::uint32_t grazing = 0, hidden = 0;
  constexpr int packets = 30;
  for (int n = 0; n < packets; ++n) {
    const std::vector<Receiver> receivers = receivers_in_a_square(random_, {0.0F, 0.0F, 1.0F});
    const std::vector<FreeRays> free = engine.count(receivers);
    for (std::size_t l = 0; l < receivers.size(); ++l) {
      std::uint32_t surely_free = 0, perhaps_free = 0;
      for (std::size_t k = 0; k < fan.size(); ++k) {
        const RayVerdict ray = verdict(city, receivers[l].p_cell, fan.direction(k));
        surely_free += ray.is_free && !ray.grazes ? 1 : 0;
        perhaps_free += ray.is_free || ray.grazes ? 1 : 0;
      }
      EXPECT_GE(free[l].likely, surely_free) << n << ", receiver " << l;
      EXPECT_LE(free[l].likely, perhaps_free) << n << ", receiver " << l;
      EXPECT_EQ(free[l].low, free[l].likely) << "nothing is unnamed";
      EXPECT_EQ(free[l].high, free[l].likely) << "nothing is unnamed";
      grazing += perhaps_free - surely_free;
      hidden += static_cast<std::uint32_t>(ray_count) - perhaps_free;
    }
  }
  // A border of the sky of 8π on the unit disk, and twice the angle wide: this share of the rays may graze it, at the most
  EXPECT_LE(grazing, 2.0 * static_cast<double>(grazing_rad) * 8.0 * packets * ReceiverPacket::lanes * ray_count);
  EXPECT_GT(hidden, packets * ReceiverPacket::lanes * ray_count / 20) << "the town hides too little to tell";
}

INSTANTIATE_TEST_SUITE_P(Towns, RayEngineInTown,
                         testing::Values(Setting{"Standing", 50, 0}, Setting{"Hanging", 0, 25}, Setting{"Both", 30, 15}),
                         [](const auto& test) { return test.param.name; });

TEST(RayEngine, AnEmptyTownHidesNothing) {
  const TownByHand empty;
  FarHorizonByHand far({});
  const HangingCity hanging(empty.skyline().hanging);
  const Occluder scene = hanging.scene();
  const RayFan fan(SkyPartition(SkyWeight::solid_angle, 145).directions());
  RayEngine engine(fan, far.map(), empty.skyline(), hanging, scene, true);
  const std::vector<Receiver> receivers{{0, {3.0F, 3.0F, 1.5F}}, {1, {4.0F, 3.0F, 1.5F}}};
  for (const FreeRays& free : engine.count(receivers)) {
    EXPECT_EQ(free.low, 145U);
    EXPECT_EQ(free.high, 145U);
  }
}

}  // namespace
}  // namespace farlod
