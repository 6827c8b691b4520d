// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/runtime/canopy/crown_scenes.hpp"

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

CanopySettings with_psi(CanopyRule rule, double psi) { return {rule, Season::leaf_on, psi}; }
CanopySettings with_kappa(double kappa_per_m) { return {CanopyRule::beer, Season::leaf_on, {}, kappa_per_m}; }

/// E3(x) = ∫ e^(−x/μ) μ dμ over 0 < μ < 1, by the rule of the middle: its second derivative is below 20 for x ≥ .05, so that the
/// error is below 20/24 · 1e-8.
double exponential_integral_3(double x) {
  constexpr int steps = 10000;
  double sum = 0.0;
  for (int n = 0; n < steps; ++n) {
    const double mu = (n + 0.5) / steps;
    sum += std::exp(-x / mu) * mu / steps;
  }
  return sum;
}

TEST(CanopyClosedForms, AnEndlessLayerPasses2E3OfItsDepth) {
  // Slopes below top / radius leave it at the side: they are (top / radius)² of the sky
  constexpr double radius_m = 10000.0, bottom_m = 2.0, thickness_m = 2.0;
  constexpr double top_over_radius = (bottom_m + thickness_m) / radius_m, side = top_over_radius * top_over_radius;
  const std::vector<Crown> layer{crown_at(CrownShape::cylinder, {}, radius_m, {bottom_m, bottom_m + thickness_m})};
  struct Layer {
    double depth, passed;
  };
  for (const Layer& l : {Layer{0.25, 0.649368}, Layer{0.5, 0.443209}, Layer{1.0, 0.219384}, Layer{2.0, 0.060267}}) {
    EXPECT_NEAR(2.0 * exponential_integral_3(l.depth), l.passed, 1e-6);
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
  EXPECT_NEAR(svf_total_at_origin(hedge, with_psi(CanopyRule::once, psi), azimuths), passed,
              azimuth_error + cut_off + form_rounding);
}

TEST(CanopyClosedForms, ASphereAtADistance) {
  constexpr double radius_m = 3.0, away_m = 5.0, height_m = 8.0, psi = 0.03, kappa_per_m = 0.3;
  const std::vector<Crown> sphere{
      crown_at(CrownShape::spheroid, {away_m, 0.0}, radius_m, {height_m - radius_m, height_m + radius_m})};
  const double share = radius_m * radius_m * height_m / std::pow(std::hypot(away_m, height_m), 3);
  EXPECT_NEAR(1.0 - (1.0 - psi) * share, 0.916820, 1e-6);
  EXPECT_NEAR(svf_total_at_origin(sphere, with_psi(CanopyRule::once, psi), azimuths), 0.916820, azimuth_error + form_rounding);
  const double x = 2.0 * kappa_per_m * radius_m, passed = 2.0 * (1.0 - (1.0 + x) * std::exp(-x)) / (x * x);
  EXPECT_NEAR(1.0 - share * (1.0 - passed), 0.942681, 1e-6);
  EXPECT_NEAR(svf_total_at_origin(sphere, with_kappa(kappa_per_m), azimuths), 0.942681,
              azimuth_error + share * quadrature_error + form_rounding);
}

TEST(CanopyClosedForms, ASpheroidOverhead) {
  const std::vector<Crown> spheroid{crown_at(CrownShape::spheroid, {}, 4.0, {7.0 - 2.5, 7.0 + 2.5})};
  EXPECT_NEAR(1.0 - 16.0 / (16.0 + 49.0 - 6.25), 0.727660, 1e-6);
  for (const CanopyRule rule : {CanopyRule::once, CanopyRule::each})
    EXPECT_NEAR(svf_total_at_origin(spheroid, with_psi(rule, 0.0), 64), 0.727660, 1e-6 + form_rounding);
}

TEST(CanopyClosedForms, ACylinderOverhead) {
  const std::vector<Crown> cylinder{crown_at(CrownShape::cylinder, {}, 3.0, {2.5, 9.0})};
  EXPECT_NEAR(1.0 - 9.0 / (9.0 + 2.5 * 2.5), 0.409836, 1e-6);
  EXPECT_NEAR(svf_total_at_origin(cylinder, with_psi(CanopyRule::once, 0.0), 64), 0.409836, 1e-6 + form_rounding);
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
    const CanopyShares shares = sky.evaluate(profile, packet, CrownBatches(spheres, with_psi(rule, psi)));
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
  EXPECT_NEAR(each.mean, 2.0 * exponential_integral_3(cover * (1.0 - psi)), 4.0 * each.standard_error + end_of_field);
  const Sample once = below_random_spheres(CanopyRule::once, psi, cover);
  EXPECT_NEAR(once.mean, psi + (1.0 - psi) * 2.0 * exponential_integral_3(cover), 4.0 * once.standard_error + end_of_field);
  EXPECT_LT(each.standard_error, 0.01);
  EXPECT_LT(once.standard_error, 0.01);
}

}  // namespace
}  // namespace farlod
