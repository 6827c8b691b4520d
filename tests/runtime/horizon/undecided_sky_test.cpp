// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/undecided_sky.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stop_token>

#include "base/cancellation.hpp"
#include "tests/runtime/horizon/fence.hpp"
#include "tests/runtime/horizon/random_places.hpp"
#include "tests/runtime/horizon/sky_oracle.hpp"

namespace farlod {
namespace {

constexpr std::size_t undecided_azimuths = 96;
constexpr std::uint32_t whole_packet = 0xFFFF;
constexpr float eye_m = 1.5F, wall_m = 12.0F;
const double rounding = sky_rounding(undecided_azimuths, {0.0F, 0.0F, 1.0F});

/// Receivers inside of a square wall, of which is known only that nothing above the slope 3 is hidden. Its horizon has a closed
/// form, (height of the wall above the eye)/(distance to the side that the azimuth meets).
class UndecidedSkyTest : public testing::Test {
 protected:
  UndecidedSkyTest() {
    std::vector<Point3f> places;
    for (int n = 0; n < 16; ++n) places.push_back({3.0F * static_cast<float>(n % 4), 2.0F * static_cast<float>(n / 4), eye_m});
    receivers_ = packet_of(places, {0.0F, 0.0F, 1.0F});
    std::vector<std::uint32_t> each(undecided_azimuths);
    std::iota(each.begin(), each.end(), 0U);
    sky_.to.raise(std::vector<float>(undecided_azimuths, 3.0F), everybody, each);
    estimate_.raise(std::vector<float>(undecided_azimuths, 0.4F), everybody, each);
  }

  static double sky_above(double slope) { return 1.0 / (1.0 + slope * slope) / static_cast<double>(undecided_azimuths); }
  static double undecided() { return static_cast<double>(undecided_azimuths) * (sky_above(0.0) - sky_above(3.0)); }
  /// What is seen of the undecided sky.
  [[nodiscard]] double truth(std::size_t lane) const {
    double seen = 0.0;
    for (std::size_t k = 0; k < undecided_azimuths; ++k) {
      const double distance = distance_to_fence(receivers_, lane, ring_.cosine()[k], ring_.sine()[k]);
      seen += sky_above((wall_m - eye_m) / distance) - sky_above(3.0);
    }
    return seen;
  }
  [[nodiscard]] UndecidedSky::Decided decided(double max_width, std::uint32_t receivers = whole_packet) {
    sky_.measure(estimate_, SkyWeight::cosine, receivers_);
    return sky_.decide({receivers, max_width, rays_per_azimuth}, {wall_, {}}, SkyWeight::cosine, receivers_);
  }

  static constexpr std::size_t rays_per_azimuth = 8;
  const AzimuthSampling ring_ = AzimuthSampling::even(undecided_azimuths, {});
  const Occluder wall_ = fence(0.0F, wall_m);
  ReceiverPacket receivers_;
  PacketHorizon estimate_{ring_};
  UndecidedSky sky_{ring_};
};

class WidthsThatAreLeft : public UndecidedSkyTest, public testing::WithParamInterface<double> {};

TEST_P(WidthsThatAreLeft, HoldTheSkyOverAWall) {
  const UndecidedSky::Decided decided = this->decided(GetParam());
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    EXPECT_LE(decided.width[l], GetParam() + rounding);
    EXPECT_GE(decided.width[l], 0.9 * GetParam() - rounding) << "more rays than are needed";
    EXPECT_LE(decided.seen[l], truth(l) + rounding);
    EXPECT_GE(decided.seen[l] + decided.width[l], truth(l) - rounding);
    EXPECT_GE(decided.expected[l], 0.0);
    EXPECT_LE(decided.expected[l], decided.width[l] + rounding);
  }
}
INSTANTIATE_TEST_SUITE_P(UndecidedSky, WidthsThatAreLeft, testing::Values(0.5, 0.1, 0.03, 0.01, 0.001, 0.0));

TEST_F(UndecidedSkyTest, OneRayHalvesAnInterval) {
  // All intervals are alike: to halve half of them leaves three quarters
  constexpr double a_little = 1e-4;
  EXPECT_EQ(decided(undecided() + a_little).rays, 0U);
  EXPECT_EQ(decided(0.75 * undecided() + a_little).rays, ReceiverPacket::lanes * undecided_azimuths / 2);
  EXPECT_EQ(decided(0.5 * undecided() + a_little).rays, ReceiverPacket::lanes * undecided_azimuths);
  EXPECT_EQ(decided(0.25 * undecided() + a_little).rays, 2 * ReceiverPacket::lanes * undecided_azimuths);
}

TEST_F(UndecidedSkyTest, TheWidestIntervalsAreHalved) {
  // Those of every fourth azimuth hold four fifths of what is undecided, and more: that they are halved once is enough
  for (std::size_t k = 0; k < undecided_azimuths; ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      if (k % 4 != 0) sky_.to.lower(k, l, 0.25F);
  const double wide = 0.25 * undecided(),
               narrow = 0.75 * static_cast<double>(undecided_azimuths) * (sky_above(0.0) - sky_above(0.25));
  EXPECT_EQ(decided(0.5 * wide + narrow + 1e-4).rays, ReceiverPacket::lanes * undecided_azimuths / 4);
}

TEST_F(UndecidedSkyTest, OnlyThoseAreDecidedWhoAreMeant) {
  constexpr std::uint32_t wanted = 0b1010'0000'0001'0110;
  const UndecidedSky::Decided all = decided(0.01), some = decided(0.01, wanted);
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    if (((wanted >> l) & 1U) == 0) continue;
    EXPECT_EQ(some.seen[l], all.seen[l]) << l;
    EXPECT_EQ(some.width[l], all.width[l]) << l;
  }
  EXPECT_LT(some.rays, all.rays);
}

TEST_F(UndecidedSkyTest, BelowSomethingThatMayOverhangSkyIsWhatTheRaysSee) {
  constexpr float foot_m = 8.0F, lowest = 0.2F;  // from no receiver is the foot below that slope
  constexpr std::size_t rays = 400;
  const Occluder hanging = fence(foot_m, wall_m);
  std::vector<std::uint32_t> each(undecided_azimuths);
  std::iota(each.begin(), each.end(), 0U);
  sky_.from.raise(std::vector<float>(undecided_azimuths, lowest), everybody, each);
  sky_.measure(estimate_, SkyWeight::cosine, receivers_);
  sky_.mark_gaps(sky_.to);
  const UndecidedSky::Decided decided = sky_.decide({whole_packet, 0.0, rays}, {hanging, {}}, SkyWeight::cosine, receivers_);
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    double below = 0.0;
    for (std::size_t k = 0; k < undecided_azimuths; ++k)
      below +=
          sky_above(lowest) - sky_above((foot_m - eye_m) / distance_to_fence(receivers_, l, ring_.cosine()[k], ring_.sine()[k]));
    // Two borders, each of which cuts a ray's part of the azimuth
    EXPECT_NEAR(decided.seen[l], truth(l) + below, 2.0 / static_cast<double>(rays)) << l;
    EXPECT_EQ(decided.width[l], 0.0);
  }
}

TEST_F(UndecidedSkyTest, AStopEndsTheTracing) {
  std::stop_source stop;
  stop.request_stop();
  sky_.measure(estimate_, SkyWeight::cosine, receivers_);
  EXPECT_THROW(
      (void)sky_.decide({whole_packet, 0.0, rays_per_azimuth, stop.get_token()}, {wall_, {}}, SkyWeight::cosine, receivers_),
      Cancelled);
}

}  // namespace
}  // namespace farlod
