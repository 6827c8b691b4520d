// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"
#include "package/crown.hpp"
#include "tests/runtime/canopy/crown_scenes.hpp"
#include "tests/runtime/canopy/ray_in_crown.hpp"

// Sky view factors with canopies that are known, of a receiver that looks up. docs/concepts.md, "Crowns", has the formulas.

namespace farlod {
namespace {

constexpr std::size_t azimuths = 16384;
/// V / (2K) of docs/concepts.md, "Above a horizon": one crown makes the sky of the azimuths fall once by at most 1, and rise
/// again.
constexpr double azimuth_error = 2.0 / (2.0 * azimuths);
/// Floats: a sum in blocks of 256 terms of at most 1.
constexpr double form_rounding = 258.0 * 0x1p-24;
/// Of the eight nodes, at most: that of a layer over the whole hemisphere of depth .25.
constexpr double quadrature_error = 1e-4;

CanopySettings with_kappa(double kappa_per_m) { return settings_of(CanopyRule::beer, {}, kappa_per_m); }

TEST(CanopyClosedForms, AnEndlessLayerPasses2E3OfItsDepth) {
  // Slopes below top / radius leave it at the side: they are (top / radius)² of the sky
  constexpr double radius_m = 10000.0, bottom_m = 2.0, thickness_m = 2.0;
  constexpr double top_over_radius = (bottom_m + thickness_m) / radius_m, side = top_over_radius * top_over_radius;
  const std::vector<Crown> layer{crown_at(CrownShape::cylinder, {}, radius_m, {bottom_m, bottom_m + thickness_m})};
  struct Layer {
    double depth, passed;
  };
  for (const Layer& l : {Layer{0.25, 0.649368}, Layer{0.5, 0.443209}, Layer{1.0, 0.219384}, Layer{2.0, 0.060267}}) {
    EXPECT_NEAR(layer_light(l.depth), l.passed, 1e-6);
    EXPECT_NEAR(svf_total_at_origin(layer, with_kappa(l.depth / thickness_m), 64), l.passed,
                quadrature_error + side + form_rounding)
        << l.depth;
  }
}

TEST(CanopyClosedForms, AnEndlessHedge) {
  // x from 6 to 8 m, z from 1.5 to 7 m. Beyond 1 km it has slopes below .007 within .016 of the azimuths
  constexpr double near_m = 6.0, width_m = 2.0, psi = 0.03, end_m = 1000.0, cut_off = 0.007 * 0.007 * 0.016;
  std::vector<Crown> hedge;
  for (double y = -end_m; y <= end_m; y += width_m)
    hedge.push_back(crown_at(CrownShape::prism, {near_m + 0.5 * width_m, y}, 0.5 * width_m, {1.5, 7.0}));
  const double low = std::atan(1.5 / (near_m + width_m)), high = std::atan(7.0 / near_m);
  const double passed = 1.0 - (1.0 - psi) * 0.5 * (std::cos(low) - std::cos(high));
  EXPECT_NEAR(passed, 0.838941, 1e-6);
  EXPECT_NEAR(svf_total_at_origin(hedge, settings_of(CanopyRule::once, psi), azimuths), passed,
              azimuth_error + cut_off + form_rounding);
}

TEST(CanopyClosedForms, ASphereAtADistance) {
  constexpr double radius_m = 3.0, away_m = 5.0, height_m = 8.0, psi = 0.03, kappa_per_m = 0.3;
  const std::vector<Crown> sphere{
      crown_at(CrownShape::spheroid, {away_m, 0.0}, radius_m, {height_m - radius_m, height_m + radius_m})};
  const double share = radius_m * radius_m * height_m / std::pow(std::hypot(away_m, height_m), 3);
  EXPECT_NEAR(1.0 - (1.0 - psi) * share, 0.916820, 1e-6);
  EXPECT_NEAR(svf_total_at_origin(sphere, settings_of(CanopyRule::once, psi), azimuths), 0.916820, azimuth_error + form_rounding);
  const double x = 2.0 * kappa_per_m * radius_m, passed = 2.0 * (1.0 - (1.0 + x) * std::exp(-x)) / (x * x);
  EXPECT_NEAR(1.0 - share * (1.0 - passed), 0.942681, 1e-6);
  EXPECT_NEAR(svf_total_at_origin(sphere, with_kappa(kappa_per_m), azimuths), 0.942681,
              azimuth_error + share * quadrature_error + form_rounding);
}

TEST(CanopyClosedForms, ASpheroidOverhead) {
  const std::vector<Crown> spheroid{crown_at(CrownShape::spheroid, {}, 4.0, {7.0 - 2.5, 7.0 + 2.5})};
  EXPECT_NEAR(1.0 - 16.0 / (16.0 + 49.0 - 6.25), 0.727660, 1e-6);
  for (const CanopyRule rule : {CanopyRule::once, CanopyRule::each})
    EXPECT_NEAR(svf_total_at_origin(spheroid, settings_of(rule, 0.0), 64), 0.727660, 1e-6 + form_rounding);
}

TEST(CanopyClosedForms, ACylinderOverhead) {
  const std::vector<Crown> cylinder{crown_at(CrownShape::cylinder, {}, 3.0, {2.5, 9.0})};
  EXPECT_NEAR(1.0 - 9.0 / (9.0 + 2.5 * 2.5), 0.409836, 1e-6);
  EXPECT_NEAR(svf_total_at_origin(cylinder, settings_of(CanopyRule::once, 0.0), 64), 0.409836, 1e-6 + form_rounding);
  EXPECT_NEAR(svf_total_at_origin(cylinder, with_kappa(0.4), 64), 0.647656, 1e-6 + quadrature_error + form_rounding);
}

// --- Spheres at random places
// --------------------------------------------------------------------------------------------------------

/// The mean of the SVF below random spheres, and its standard error.
struct Sample {
  double mean = 0.0, standard_error = 0.0;
};
Sample below_random_spheres(CanopyRule rule, double psi, double cover) {
  constexpr double radius_m = 2.0, height_m = 6.0, half_m = 150.0;
  const auto count = static_cast<std::size_t>(cover * 4.0 * half_m * half_m / (std::numbers::pi * radius_m * radius_m));
  const AzimuthSampling sampling = AzimuthSampling::even(32, {});
  CanopySky sky(sampling);
  const SkyProfile profile(sampling);
  RandomPlaces random;
  double sum = 0.0, squares = 0.0, values = 0.0;
  for (int scene = 0; scene < 50; ++scene) {
    std::vector<Crown> spheres;
    for (std::size_t n = 0; n < count; ++n) {
      const Point3f p = random.place(half_m, 0.0, 1.0);
      spheres.push_back(crown_at(CrownShape::spheroid, {p.x, p.y}, radius_m, {height_m - radius_m, height_m + radius_m}));
    }
    // Each scene has receivers so far apart that they see different spheres near them
    ReceiverPacket packet;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      packet.add(
          {l, {20.0F * static_cast<float>(l % 4) - 30.0F, 20.0F * static_cast<float>(l / 4) - 30.0F, 0.0F}, {0.0F, 0.0F, 1.0F}});
    const CanopyShares shares = sky.evaluate(profile, packet, CrownBatches(spheres, settings_of(rule, psi)));
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      const auto value = static_cast<double>(shares.svf_total(l, 1.0F));
      sum += value;
      squares += value * value;
      values += 1.0;
    }
  }
  const double mean = sum / values;
  return {mean, std::sqrt((squares / values - mean * mean) / values)};
}

TEST(CanopyClosedForms, RandomSpheresPassWhatALayerOfTheirDepthPasses) {
  constexpr double psi = 0.3, cover = 0.6;
  // The field ends at 120 m from a receiver or farther: slopes below 8 / 120
  constexpr double end_of_field = (8.0 / 120.0) * (8.0 / 120.0);
  const Sample each = below_random_spheres(CanopyRule::each, psi, cover);
  EXPECT_NEAR(each.mean, layer_light(cover * (1.0 - psi)), 4.0 * each.standard_error + end_of_field);
  const Sample once = below_random_spheres(CanopyRule::once, psi, cover);
  EXPECT_NEAR(once.mean, psi + (1.0 - psi) * layer_light(cover), 4.0 * once.standard_error + end_of_field);
  EXPECT_LT(each.standard_error, 0.01);
  EXPECT_LT(once.standard_error, 0.01);
}

// Random crowns, horizons, gaps and normals against rays.

/// The share of the light that passes all crowns along a ray, and whether it meets any.
struct Passed {
  double light = 1.0;
  bool meets = false;
};
Passed passed(std::span<const Crown> crowns, const CanopySettings& settings, const Point3d& eye, const Point3d& direction) {
  Passed result;
  for (const Crown& crown : crowns) {
    const RayPart part = part_in_crown(crown, eye, direction);
    const double length = part.second - std::max(0.0, part.first);
    if (length <= 0.0) continue;
    result.meets = true;
    const double psi = transmissivity_of(crown.foliage, settings);
    if (settings.rule == CanopyRule::once) result.light = std::min(result.light, psi);
    if (settings.rule == CanopyRule::each) result.light *= psi;
    if (settings.rule == CanopyRule::beer) result.light *= std::exp(-extinction_per_m_of(crown.foliage, settings) * length);
  }
  return result;
}

/// Shares of the sky as CanopyShares has them, and that of the profile. The error is that of the rule of the middle for what
/// varies by V along the elevation: V/2 of a step, by the proof of docs/concepts.md, "The error of K azimuths". Twice that, since
/// V is what the rays show of it.
struct JudgedShares {
  double lost = 0.0, behind = 0.0, sky = 0.0, error = 0.0;
};

/// By rays at the azimuths of a sampling and in the middles of `steps` equal parts of the elevation, for the sky above `sky_from`
/// and in gaps.
JudgedShares judged_shares(std::span<const Crown> crowns, const CanopySettings& settings, const AzimuthSampling& azimuths,
                           const SkyProfile& profile, const ReceiverPacket& receivers, std::size_t lane, int steps) {
  const Point3d eye{receivers.x[lane], receivers.y[lane], receivers.z[lane]};
  const Point3d normal{receivers.normal_x[lane], receivers.normal_y[lane], receivers.normal_z[lane]};
  const double step = 0.5 * std::numbers::pi / steps;
  JudgedShares sums;
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    double lost_before = 0.0, behind_before = 0.0, variation = 0.0;
    for (int n = 0; n < steps; ++n) {
      const double elevation = (n + 0.5) * step, across = std::cos(elevation), slope = std::tan(elevation);
      double share = slope > double{profile.sky_from[k][lane]} ? 1.0 : 0.0;
      if (!profile.gap_share.empty() && slope > double{profile.gap_from[k][lane]} && slope < double{profile.gap_to[k][lane]})
        share += double{profile.gap_share[k][lane]};
      const Point3d d{across * double{azimuths.cosine()[k]}, across * double{azimuths.sine()[k]}, std::sin(elevation)};
      const double weight = 2.0 * step * across * share * std::max(0.0, d.x * normal.x + d.y * normal.y + d.z * normal.z);
      const Passed p = weight == 0.0 ? Passed{} : passed(crowns, settings, eye, d);
      const double lost = weight * (1.0 - p.light), behind = p.meets ? weight : 0.0;
      sums.sky += weight;
      sums.lost += lost;
      sums.behind += behind;
      variation += std::max(std::abs(lost - lost_before), std::abs(behind - behind_before));
      lost_before = lost;
      behind_before = behind;
    }
    sums.error += variation + behind_before;
  }
  const auto count = static_cast<double>(azimuths.size());
  return {sums.lost / count, sums.behind / count, sums.sky / count, sums.error / count};
}

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
