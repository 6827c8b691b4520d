// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "farlod/angle.hpp"
#include "horizon/packet_horizon.hpp"
#include "tests/runtime/horizon/random_places.hpp"
#include "tests/runtime/horizon/sky_oracle.hpp"

namespace farlod {
namespace {

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};
constexpr Point3f up{0.0F, 0.0F, 1.0F}, down{0.0F, 0.0F, -1.0F};

/// Normals that look up, up a little aside, along a roof, along a wall, slightly and steeply downward.
std::vector<Point3f> some_normals(RandomPlaces& random) {
  std::vector<Point3f> normals{up, down, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, {-0.6F, 0.0F, 0.8F}, {0.0F, 0.8F, -0.6F}};
  for (const double z : {0.999, 0.9, 0.5, 0.1, 0.01, 0.0, -0.01, -0.3, -0.9, -0.999}) normals.push_back(random.direction_at(z));
  return normals;
}

/// A receiver in each lane, each with a normal and a horizon of its own: level parts, low and high ones, some up to the zenith.
class RandomHorizons {
 public:
  explicit RandomHorizons(const AzimuthSampling& ring) : ring_(ring), horizon_(ring) {
    std::vector<std::uint32_t> bins(ring.size());
    std::iota(bins.begin(), bins.end(), 0U);
    for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane) {
      for (std::size_t k = 0; k < ring.size(); ++k) slopes_[lane].push_back(some_slope());
      horizon_.raise(slopes_[lane], only(lane), bins);
    }
  }
  [[nodiscard]] const PacketHorizon& horizon() const { return horizon_; }
  [[nodiscard]] double expected(SkyWeight weight, std::size_t lane, const Point3f& normal) const {
    return expected_sky(weight, normal, ring_, [&](std::size_t k) { return double{slopes_[lane][k]}; });
  }

 private:
  float some_slope() {
    const float kind = random_.between(0.0, 1.0);
    if (kind < 0.15F) return 0.0F;
    if (kind > 0.97F) return std::numeric_limits<float>::infinity();
    return std::tan(random_.between(0.0, kind < 0.5F ? 0.2 : 1.55));
  }
  const AzimuthSampling& ring_;
  RandomPlaces random_;
  PacketHorizon horizon_;
  std::array<std::vector<float>, ReceiverPacket::lanes> slopes_;
};

ReceiverPacket packet_with(std::span<const Point3f> normals) {
  ReceiverPacket packet;
  for (std::size_t n = 0; n < ReceiverPacket::lanes; ++n) packet.add({n, {}, normals[n % normals.size()]});
  return packet;
}

TEST(SkyAbove, IsTheIntegralOverRandomHorizons) {
  RandomPlaces random;
  for (const std::size_t azimuths : {1U, 8U, 64U, 256U}) {
    const AzimuthSampling ring = AzimuthSampling::even(azimuths, GridRotation(Angle::degrees(11.0)));
    const RandomHorizons random_horizons(ring);
    const std::vector<Point3f> normals = some_normals(random);
    for (const SkyWeight weight : both_weights) {
      const auto sky = random_horizons.horizon().sky_above(weight, packet_with(normals));
      for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane)
        EXPECT_NEAR(sky[lane], random_horizons.expected(weight, lane, normals[lane]), sky_rounding(azimuths, normals[lane]))
            << "lane " << lane << ", normal z " << normals[lane].z;
    }
  }
}

TEST(SkyAbove, WhereAllLookUpAsWellAsWhereOneDoesNot) {
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  const RandomHorizons random_horizons(ring);
  std::vector<Point3f> normals(ReceiverPacket::lanes, up);
  const auto alone = random_horizons.horizon().sky_above(SkyWeight::cosine, packet_with(normals));
  normals.back() = {0.6F, 0.0F, 0.8F};
  const auto mixed = random_horizons.horizon().sky_above(SkyWeight::cosine, packet_with(normals));
  for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane) {
    EXPECT_NEAR(alone[lane], random_horizons.expected(SkyWeight::cosine, lane, up), sky_rounding(64, up));
    if (lane + 1 < ReceiverPacket::lanes) {
      EXPECT_NEAR(mixed[lane], alone[lane], 2.0 * sky_rounding(64, up));
    }
  }
}

TEST(SkyAbove, WhereAllLookLevelAsWellAsWhereOneDoesNot) {
  RandomPlaces random;
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  const RandomHorizons random_horizons(ring);
  // Of one wall, and of many
  for (const bool alike : {true, false}) {
    std::vector<Point3f> normals(ReceiverPacket::lanes, random.direction_at(0.0));
    if (!alike)
      for (Point3f& normal : normals) normal = random.direction_at(0.0);
    const auto sky = random_horizons.horizon().sky_above(SkyWeight::cosine, packet_with(normals));
    for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane)
      EXPECT_NEAR(sky[lane], random_horizons.expected(SkyWeight::cosine, lane, normals[lane]), sky_rounding(64, normals[lane]));
  }
}

TEST(SkyAbove, ALevelHorizonLeavesAllAndAnEndlessOneNothing) {
  const AzimuthSampling ring = AzimuthSampling::even(256, {});
  PacketHorizon horizon(ring);
  const std::vector<Point3f> ups(ReceiverPacket::lanes, up), downs(ReceiverPacket::lanes, down);
  for (const SkyWeight weight : both_weights) {
    for (const float share : horizon.sky_above(weight, packet_with(ups))) EXPECT_EQ(share, 1.0F);
    for (const float share : horizon.sky_above(weight, packet_with(downs))) EXPECT_EQ(share, 0.0F);
  }
  const std::vector<float> endless{std::numeric_limits<float>::infinity()};
  horizon.raise(endless, everybody, std::vector<std::uint32_t>(ring.size(), 0));
  for (const SkyWeight weight : both_weights)
    for (const float share : horizon.sky_above(weight, packet_with(ups))) EXPECT_EQ(share, 0.0F);
}

/// An even horizon is rounded the same way at each azimuth, so that errors add up and do not cancel.
TEST(SkyAbove, ManyAzimuthsRoundNoMoreThanFew) {
  constexpr std::size_t azimuths = 300'000;
  const AzimuthSampling ring = AzimuthSampling::even(azimuths, {});
  const std::vector<Point3f> ups(ReceiverPacket::lanes, up), level(ReceiverPacket::lanes, {1.0F, 0.0F, 0.0F}),
      tilted(ReceiverPacket::lanes, {0.6F, 0.0F, 0.8F});
  for (const float slope : {0.1F, 0.3F, 0.7F, 1.9F}) {
    PacketHorizon horizon(ring);
    horizon.raise(std::vector{slope}, everybody, std::vector<std::uint32_t>(azimuths, 0));
    // Parts of the normal that point outwards average to 0, and those in front of a wall to 1/π
    const double t = slope, upwards = 1.0 / (1.0 + t * t), wall = (std::atan(1.0 / t) - t * upwards) / std::numbers::pi;
    EXPECT_NEAR(horizon.sky_above(SkyWeight::cosine, packet_with(ups))[0], upwards, sky_rounding(azimuths, up));
    EXPECT_NEAR(horizon.sky_above(SkyWeight::cosine, packet_with(level))[0], wall, sky_rounding(azimuths, level[0]));
    EXPECT_NEAR(horizon.sky_above(SkyWeight::solid_angle, packet_with(ups))[0], 1.0 - t / std::sqrt(1.0 + t * t),
                sky_rounding(azimuths, up));
    // Behind the tilted receiver, too, the sky is above its own plane of slope 0.75
    if (slope > 0.75F) {
      EXPECT_NEAR(horizon.sky_above(SkyWeight::cosine, packet_with(tilted))[0], 0.8 * upwards, sky_rounding(azimuths, tilted[0]));
    }
  }
}

}  // namespace
}  // namespace farlod
