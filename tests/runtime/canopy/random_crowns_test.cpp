// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/runtime/canopy/crown_scenes.hpp"
#include "tests/runtime/canopy/ray_judge.hpp"

// Random crowns, horizons, gaps and normals against rays.

namespace farlod {
namespace {

constexpr CanopyRule judged_rules[] = {CanopyRule::once, CanopyRule::each, CanopyRule::beer};
constexpr Looks judged_looks[] = {Looks::up, Looks::level, Looks::anywhere};
constexpr std::size_t azimuth_count = 16;
constexpr int elevations = 1500;
/// Of the kernels: the quadrature, which is exact but for the rule `beer`, on all of the sky; and floats.
constexpr double kernel_error = 2e-4;

struct RandomScene {
  std::vector<Crown> crowns;
  CanopySettings settings;
  Looks looks = Looks::up;
  bool has_gaps = false;
};

/// With the scene's number, so that it can be repeated alone.
RandomScene scene_of(unsigned number, RandomPlaces& random) {
  RandomScene scene;
  scene.crowns = some_crowns(random, number % 5 == 0 ? 2 : 12, number % 4 == 0 ? 5.0 : 25.0);
  scene.looks = judged_looks[number % 3];
  scene.has_gaps = number % 2 == 1;
  scene.settings.rule = judged_rules[number / 3 % 3];
  scene.settings.season = number / 9 % 2 == 0 ? Season::leaf_on : Season::leaf_off;
  scene.settings.extinction_per_m = 0.3;
  return scene;
}

TEST(RandomCrowns, TakeWhatRaysSay) {
  const AzimuthSampling azimuths = AzimuthSampling::even(azimuth_count, GridRotation(Angle::degrees(7.0)));
  CanopySky sky(azimuths);
  RandomPlaces random;
  for (unsigned number = 0; number < 54; ++number) {
    const RandomScene scene = scene_of(number, random);
    const ReceiverPacket receivers = some_receivers(random, scene.looks);
    const SkyProfile profile = some_profile(random, azimuths, scene.has_gaps);
    const CanopyShares shares = sky.evaluate(profile, receivers, CrownBatches(scene.crowns, scene.settings));
    for (const std::size_t lane : {std::size_t{number % 8}, std::size_t{8 + number % 7}}) {
      const JudgedShares judged = judged_shares(scene.crowns, scene.settings, azimuths, profile, receivers, lane, elevations);
      EXPECT_NEAR(static_cast<double>(shares.lost[lane]), judged.lost, judged.error + kernel_error)
          << "scene " << number << ", lane " << lane;
      EXPECT_NEAR(static_cast<double>(shares.behind[lane]), judged.behind, judged.error + kernel_error)
          << "scene " << number << ", lane " << lane;
    }
  }
}

/// Receivers all around one crown, in its plan and beside it, below, in and above it: also between its upper surface and the
/// height of its highest point.
TEST(RandomCrowns, OneCrownTakesWhatRaysSayFromAllAround) {
  const AzimuthSampling azimuths = AzimuthSampling::even(azimuth_count, GridRotation(Angle::degrees(7.0)));
  CanopySky sky(azimuths);
  const SkyProfile profile(azimuths);
  for (const CrownShape shape : {CrownShape::spheroid, CrownShape::cylinder, CrownShape::prism}) {
    Crown crown = crown_at(shape, {1.0, 2.0}, 3.0, {2.0, 8.0});
    if (shape == CrownShape::prism) crown.turn = 20000;
    for (const CanopyRule rule : {CanopyRule::each, CanopyRule::beer})
      for (const float away_m : {0.0F, 1.0F, 2.0F, 2.9F, 3.1F, 6.0F}) {
        ReceiverPacket receivers;
        for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
          receivers.add({l, {1.0F + away_m, 2.2F, 0.55F * static_cast<float>(l) + 0.3F}, {0.0F, 0.0F, 1.0F}});
        const CanopySettings settings{rule, Season::leaf_on, {}, 0.2}, by_once{CanopyRule::once};
        const CanopyShares shares = sky.evaluate(profile, receivers, CrownBatches({&crown, 1}, settings)),
                           once = sky.evaluate(profile, receivers, CrownBatches({&crown, 1}, by_once));
        for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
          const JudgedShares judged = judged_shares({&crown, 1}, settings, azimuths, profile, receivers, l, 400);
          EXPECT_NEAR(static_cast<double>(shares.lost[l]), judged.lost, judged.error + kernel_error)
              << away_m << " m, lane " << l;
          EXPECT_NEAR(static_cast<double>(once.behind[l]), judged.behind, judged.error + kernel_error)
              << away_m << " m, lane " << l;
        }
      }
  }
}

/// Pixels of a canopy: more intervals at an azimuth than any other scene has.
TEST(RandomCrowns, PixelsOfACanopyTakeWhatRaysSay) {
  const AzimuthSampling azimuths = AzimuthSampling::even(azimuth_count, {});
  RandomPlaces random;
  std::vector<Crown> pixels;
  for (int x = -20; x < 20; ++x)
    for (int y = -20; y < 20; ++y)
      if (random.between(0.0, 1.0) < 0.25F)
        pixels.push_back(
            crown_at(CrownShape::prism, {x + 0.5, y + 0.5}, 0.5, {random.between(0.5, 4.0), random.between(4.0, 12.0)}));
  const ReceiverPacket receivers = some_receivers(random, Looks::up);
  for (const CanopyRule rule : judged_rules) {
    const CanopySettings settings{rule, Season::leaf_on, {}, 0.2};
    const SkyProfile profile = some_profile(random, azimuths, false);
    const CanopyShares shares = CanopySky(azimuths).evaluate(profile, receivers, CrownBatches(pixels, settings));
    const JudgedShares judged = judged_shares(pixels, settings, azimuths, profile, receivers, 3, elevations);
    EXPECT_NEAR(static_cast<double>(shares.lost[3]), judged.lost, judged.error + kernel_error);
    EXPECT_NEAR(static_cast<double>(shares.behind[3]), judged.behind, judged.error + kernel_error);
  }
}

/// Crowns are sampled in the middles of K parts of the turn: docs/concepts.md, "Crowns", has what that costs. Twice the errors
/// that were measured there.
TEST(RandomCrowns, ErrorOfTheAzimuthsIsSmallAndOfNoSign) {
  constexpr std::size_t count = 320, fine_count = 8192;
  constexpr double rms_allowed = 2.0 * 0.25 / count, max_allowed = 2.0 * 0.9 / count, mean_allowed = 0.2 * rms_allowed;
  const AzimuthSampling azimuths = AzimuthSampling::even(count, {}), fine = AzimuthSampling::even(fine_count, {});
  RandomPlaces random;
  std::vector<Crown> crowns;
  for (int n = 0; n < 600; ++n) {
    const Point3f p = random.place(120.0, 1.5, 4.0);
    crowns.push_back(
        crown_at(static_cast<CrownShape>(n % 3), {p.x, p.y}, random.between(2.0, 4.0), {p.z, p.z + random.between(4.0, 10.0)}));
  }
  const CrownBatches batches(crowns, CanopySettings{});
  double sum = 0.0, squares = 0.0, values = 0.0;
  for (int n = 0; n < 20; ++n) {
    const ReceiverPacket receivers = some_receivers(random, Looks::up);
    const CanopyShares shares = CanopySky(azimuths).evaluate(SkyProfile(azimuths), receivers, batches),
                       truth = CanopySky(fine).evaluate(SkyProfile(fine), receivers, batches);
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      const double error = static_cast<double>(shares.lost[l]) - static_cast<double>(truth.lost[l]);
      sum += error;
      squares += error * error;
      values += 1.0;
      EXPECT_LE(std::abs(error), max_allowed);
    }
  }
  EXPECT_LE(std::sqrt(squares / values), rms_allowed);
  EXPECT_LE(std::abs(sum / values), mean_allowed);
}

}  // namespace
}  // namespace farlod
