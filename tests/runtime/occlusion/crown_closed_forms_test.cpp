// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "occlusion/crown_occluder.hpp"
#include "tests/runtime/canopy/crowns_by_hand.hpp"

// Sky view factors below crowns that have a closed form, by the rays of a Fibonacci lattice.

namespace farlod {
namespace {

constexpr std::size_t direction_count = 1'000'000;

Point3f direction_of(std::size_t n, std::size_t count) {
  const double u = (static_cast<double>(n) + 0.5) / static_cast<double>(count), golden = std::numbers::phi;
  const double turns = static_cast<double>(n) / golden, azimuth_rad = 2.0 * std::numbers::pi * (turns - std::floor(turns));
  return {static_cast<float>(std::sqrt(u) * std::cos(azimuth_rad)), static_cast<float>(std::sqrt(u) * std::sin(azimuth_rad)),
          static_cast<float>(std::sqrt(1.0 - u))};
}

/// Of what crowns leave of the sky: sixteen neighboring directions at once, from one place.
double svf(const CrownOccluder& crowns, const Point3f& place, std::size_t count = direction_count) {
  RayOrigins origins;
  origins.x.fill(place.x), origins.y.fill(place.y), origins.z.fill(place.z);
  double sum = 0.0;
  for (std::size_t first = 0; first < count; first += RayOrigins::lanes) {
    Occluder::Directions directions;
    const std::size_t rays = std::min(RayOrigins::lanes, count - first);
    for (std::size_t l = 0; l < rays; ++l) {
      const Point3f d = direction_of(first + l, count);
      directions.x[l] = d.x, directions.y[l] = d.y, directions.z[l] = d.z;
    }
    const CrownLights lights = crowns.light(origins, directions, 0.0F, (1U << rays) - 1U, CrownQuestion::light);
    for (std::size_t l = 0; l < rays; ++l) sum += lights.transmitted[l];
  }
  return sum / static_cast<double>(count);
}

/// Each direction stands for a cell of the lattice of 1/N of the sky. A region of the sky whose border is B radii of the disk
/// long crosses about B √(N/π) cells, and is wrong by a part of each, of variance 1/12, of either sign: six standard deviations.
/// No region here has a longer border than the horizon, with B = 2π.
const double border_error =
    6.0 * std::sqrt(2.0 * std::numbers::pi * std::sqrt(direction_count / std::numbers::pi) / 12.0) / direction_count;
/// Of a closed form that is written with six digits.
constexpr double six_digits = 0.5e-6;
/// A share is a float, and the mean of many is as wrong as one is, at the most.
constexpr double share_rounding = 0x1p-25;

TEST(ClosedForms, AnEndlessLayer) {
  // It ends 1,000 km away: below an elevation of 1e-5, of which the sky has the square
  constexpr double edge_m = 1e6;
  const struct { double depth, light; } layers[] = {{0.25, 0.649368}, {0.5, 0.443209}, {1.0, 0.219384}, {2.0, 0.060267}};
  for (const auto& [depth, light] : layers)
    for (const CrownShape shape : {CrownShape::cylinder, CrownShape::prism}) {
      EXPECT_NEAR(layer_light(depth), light, six_digits);
      const Crown layer =
          crown_at(shape, {3.0, -4.0}, edge_m, {10.0, 12.0}, Foliage::unknown, shape == CrownShape::prism ? 9999 : 0);
      const CrownOccluder occluder({layer}, settings_of(CanopyRule::beer, {}, depth / 2.0));
      // The light is a smooth function of the ring of directions, whose mean the lattice takes by the middles of N steps: an
      // error of the order of its slope over N², far below that of the floats of a direction. Six of those, relative, are in the
      // length
      const double direction_rounding = 6.0 * 0x1p-24;
      EXPECT_NEAR(svf(occluder, {}), light, six_digits + share_rounding + direction_rounding) << depth;
    }
}

TEST(ClosedForms, AHedge) {
  // From x = 6 to 8 m, from 1.5 to 7 m high, endless: 2 km to either side. What lies beyond is seen at elevations below 7/2000,
  // in 7/2000 of the azimuths
  std::vector<Crown> hedge;
  for (int n = -1000; n <= 1000; ++n) hedge.push_back(crown_at(CrownShape::prism, {7.0, 2.0 * n}, 1.0, {1.5, 7.0}));
  const double low_rad = std::atan(1.5 / 8.0), high_rad = std::atan(7.0 / 6.0);
  const double light = 1.0 - (1.0 - 0.03) / 2.0 * (std::cos(low_rad) - std::cos(high_rad));
  EXPECT_NEAR(light, 0.838941, six_digits);
  const double beyond = std::pow(7.0 / 2000.0, 3);
  EXPECT_NEAR(svf(CrownOccluder(hedge, settings_of(CanopyRule::once)), {}), light, border_error + beyond);
}

TEST(ClosedForms, ASphereBesideAndASpheroidAndACylinderAbove) {
  const struct {
    const char* what;
    Crown crown;
    CanopySettings settings;
    double light;
  } cases[] = {
      {"sphere", crown_at(CrownShape::spheroid, {3.0, 4.0}, 3.0, {5.0, 11.0}), settings_of(CanopyRule::once), 0.916820},
      {"sphere of leaves", crown_at(CrownShape::spheroid, {3.0, 4.0}, 3.0, {5.0, 11.0}), settings_of(CanopyRule::beer, {}, 0.3),
       0.942681},
      {"spheroid", crown_at(CrownShape::spheroid, {0.0, 0.0}, 4.0, {4.5, 9.5}), settings_of(CanopyRule::each, 0.0), 0.727660},
      {"cylinder", crown_at(CrownShape::cylinder, {0.0, 0.0}, 3.0, {2.5, 9.0}), settings_of(CanopyRule::once, 0.0), 0.409836},
      {"cylinder of leaves", crown_at(CrownShape::cylinder, {0.0, 0.0}, 3.0, {2.5, 9.0}), settings_of(CanopyRule::beer, {}, 0.4),
       0.647656}};
  for (const auto& [what, crown, settings, light] : cases)
    EXPECT_NEAR(svf(CrownOccluder({crown}, settings), {}), light, six_digits + border_error) << what;
}

/// Spheres of 2 m radius, thrown at random over a square of 500 m, 6 to 12 m above the ground: q of them above each place, on
/// average.
std::vector<Crown> thrown_spheres(double q, unsigned seed) {
  constexpr double edge_m = 500.0, radius_m = 2.0;
  std::mt19937_64 random(seed);
  const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::poisson_distribution<std::size_t> count(q * edge_m * edge_m / (std::numbers::pi * radius_m * radius_m));
  std::vector<Crown> spheres(count(random));
  for (Crown& sphere : spheres) {
    const double bottom_m = 6.0 + 2.0 * share();
    sphere = crown_at(CrownShape::spheroid, {edge_m * (share() - 0.5), edge_m * (share() - 0.5)}, radius_m,
                      {bottom_m, bottom_m + 2.0 * radius_m});
  }
  return spheres;
}

/// The mean of forests, each seen from places 20 m apart, and the standard error of that mean.
std::pair<double, double> mean_light(double q, const CanopySettings& settings) {
  constexpr unsigned forests = 20;
  constexpr std::size_t directions = 400;
  double sum = 0.0, squares = 0.0;
  for (unsigned forest = 0; forest < forests; ++forest) {
    const CrownOccluder crowns(thrown_spheres(q, forest), settings);
    double of_forest = 0.0;
    for (int place = 0; place < 100; ++place)
      of_forest += svf(crowns, {20.0F * static_cast<float>(place % 10 - 5), 20.0F * static_cast<float>(place / 10 - 5), 0.0F},
                       directions) /
                   100.0;
    sum += of_forest, squares += of_forest * of_forest;
  }
  const double mean = sum / forests;
  return {mean, std::sqrt((squares / forests - mean * mean) / (forests - 1))};
}

TEST(ClosedForms, SpheresThrownAtRandom) {
  constexpr double q = 0.5, psi = 0.4;
  const auto [once, once_error] = mean_light(q, settings_of(CanopyRule::once, psi));
  const auto [each, each_error] = mean_light(q, settings_of(CanopyRule::each, psi));
  // A direction that leaves the square of the forest, 150 m away or more, would have met q/sin(4.6°) = 6 more spheres on average
  const double beyond = std::pow(12.0 / 150.0, 2) * std::exp(-6.0 * (1.0 - psi));
  EXPECT_NEAR(once, psi + (1.0 - psi) * layer_light(q), 4.0 * once_error + beyond);
  EXPECT_NEAR(each, layer_light(q * (1.0 - psi)), 4.0 * each_error + beyond);
  EXPECT_LT(std::max(once_error, each_error), 0.01) << "the forests tell little";
}

}  // namespace
}  // namespace farlod
