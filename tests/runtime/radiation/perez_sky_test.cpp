// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "radiation/perez_sky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace farlod {
namespace {

Angle distance_between(Angle zenith_a, Angle zenith_b, Angle turn_between) {
  const double cosine = cos(zenith_a) * cos(zenith_b) + sin(zenith_a) * sin(zenith_b) * cos(turn_between);
  return Angle::radians(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

/// A sky of each bin of clearness; relative radiances at the zenith, 45° below it towards the sun and at right angles to it, and
/// 10° high opposite of it.
struct KnownSky {
  double sun_zenith_deg, direct_normal_w_m2, diffuse_w_m2, clearness, brightness;
  std::array<double, 4> radiances;
};

// What the formulas of gendaymtx 2.5 of Radiance (CalcSkyClearness, CalcSkyBrightness, CalcPerezParam, CalcRelLuminance) yield,
// with 1,367 W/m² outside of the atmosphere, evaluated in Python
constexpr std::array<KnownSky, 8> known_skies{{{60, 0, 120, 1.0000, 0.1749, {2.0101, 2.1517, 1.8394, 1.2174}},
                                               {70, 30, 140, 1.0739, 0.2970, {0.6765, 2.6082, 0.8437, 1.0960}},
                                               {50, 90, 250, 1.2128, 0.2839, {1.1909, 6.0486, 1.1637, 1.0906}},
                                               {30, 300, 330, 1.7909, 0.2785, {2.3640, 5.3087, 1.3561, 1.0540}},
                                               {40, 420, 260, 2.1929, 0.2480, {1.2420, 7.1914, 0.9976, 1.0079}},
                                               {55, 480, 150, 2.6660, 0.1908, {0.5700, 4.0294, 0.6110, 0.9448}},
                                               {45, 700, 120, 4.8777, 0.1239, {0.4414, 4.8140, 0.4048, 0.8708}},
                                               {35, 880, 90, 8.9025, 0.0803, {0.4661, 2.4854, 0.3808, 0.8300}}}};
constexpr double half_of_last_digit = 0.5e-4;

TEST(PerezSky, IsThatOfRadiance) {
  for (const KnownSky& known : known_skies) {
    SCOPED_TRACE(known.clearness);
    const Angle sun = Angle::degrees(known.sun_zenith_deg);
    const SkyState state = sky_state(sun, {known.diffuse_w_m2, known.direct_normal_w_m2, 1367.0});
    EXPECT_NEAR(state.clearness, known.clearness, half_of_last_digit);
    EXPECT_NEAR(state.brightness, known.brightness, half_of_last_digit);
    const PerezSky sky(state);
    const std::array<std::array<double, 2>, 4> places{{{0, 0}, {45, 0}, {45, 90}, {80, 180}}};
    for (std::size_t n = 0; n < places.size(); ++n) {
      const Angle zenith = Angle::degrees(places[n][0]);
      EXPECT_NEAR(sky.radiance(zenith, distance_between(sun, zenith, Angle::degrees(places[n][1]))), known.radiances[n],
                  half_of_last_digit)
          << n;
    }
  }
}

TEST(PerezSky, IsNowhereNegative) {
  for (const double clearness : {1.0, 1.1, 1.3, 1.7, 2.2, 3.0, 5.0, 12.0})
    for (double brightness = 0.02; brightness < 0.9; brightness += 0.08)
      for (double sun_deg = 0.0; sun_deg < 90.0; sun_deg += 7.0) {
        const PerezSky sky({Angle::degrees(sun_deg), clearness, brightness});
        for (double zenith_deg = 0.0; zenith_deg < 90.0; zenith_deg += 8.9)
          for (double sun_distance_deg = 0.0; sun_distance_deg < 180.0; sun_distance_deg += 20.0)
            ASSERT_GE(sky.radiance(Angle::degrees(zenith_deg), Angle::degrees(sun_distance_deg)), 0.0)
                << clearness << " " << brightness << " " << sun_deg;
      }
}

TEST(OvercastSky, IsThriceAsBrightAtTheZenithAsAtTheHorizon) {
  EXPECT_DOUBLE_EQ(overcast_radiance(Angle()), 1.0);
  EXPECT_NEAR(overcast_radiance(Angle::degrees(90.0)), 1.0 / 3.0, 1e-15);
}

}  // namespace
}  // namespace farlod
