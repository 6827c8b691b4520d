// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>

#include "evaluate/sky_evaluator.hpp"
#include "receivers/point_receivers.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// Where the grid happens to lie must not show in the exact answers: neither of the engine that traces all, nor of the one that
// traces only what the far map leaves open, nor of horizons.

namespace farlod {
namespace {

constexpr std::size_t rays = 4000;
constexpr double cell_m = 20.0, nearest_m = 1.0;

/// Coordinates of the tiles, of the scene and of a receiver, all below 128 m, are floats: each off by half of the last digit.
constexpr double place_error_m = 3 * 0.5 * 128.0 * static_cast<double>(std::numeric_limits<float>::epsilon());

/// A ray changes its answer when it passes an edge within the angle that the rounding makes at the nearest wall. The border
/// between sky and city is at most 4π long on the unit disk, so that the rays expected within that angle of it are rays · (2 ·
/// angle · 4π)/π < 1/2. Five changes have a probability below 1/2^5/5! (Poisson): that many are allowed, at most.
constexpr double expected_changes = static_cast<double>(rays) * 8.0 * place_error_m / nearest_m;
static_assert(expected_changes < 1.0);
constexpr double allowed_change = 5.0 / static_cast<double>(rays);

/// Likewise an azimuth of a horizon: it passes one of at most 64 jumps within the angle with the probability 64 · 2 · angle ·
/// 256/2π < 1/8, so that three of 256 changes have one below 1/8³/3!; each weighs at most one azimuth. Slopes are rounded
/// besides.
constexpr std::size_t azimuths = 256;
constexpr double expected_jumps = 64.0 * 2.0 * place_error_m / nearest_m * static_cast<double>(azimuths) / 6.2;
static_assert(expected_jumps < 0.125);
constexpr double allowed_change_of_horizons = 3.0 / static_cast<double>(azimuths);

/// Horizons are compared where all is near: what the far map leaves open would depend on the grid.
struct Way {
  Engine engine;
  int neighborhood;
  double allowed_change;
};

std::vector<Point2d> places() {
  std::vector<Point2d> result;
  for (int n = 0; n < 40; ++n) result.push_back({-14.0 + 2.9 * (n % 10), -1.3 + 0.9 * (n / 10)});
  return result;
}

/// Two rows of houses and a tower, beside a street from west to east.
CityModel street(const Point3d& shift) {
  scenes::SceneBuilder builder(shift);
  for (int n = 0; n < 5; ++n) {
    const double x = -30.0 + 12.0 * n;
    builder.add_box({{x, 4.0}, {x + 11.0, 14.0}}, 0.0, 7.0 + 2 * n);
    builder.add_box({{x + 3.0, -15.0}, {x + 14.0, -4.0}}, 0.0, 15.0 - 2 * n);
  }
  builder.add_box({{-3.0, 20.0}, {5.0, 27.0}}, 0.0, 60.0);
  return builder.city();
}

std::vector<float> svf_on(const Way& way, const Point3d& shift, double bearing_deg) {
  const CityModel city = street(shift);
  const Grid grid = scenes::grid_covering(city, Angle::degrees(bearing_deg), cell_m, way.neighborhood, 4);
  const scenes::TemporaryFolder folder;
  scenes::pack_city(city, grid, folder.path() / "street.farlod", scenes::small_maps(FarMapKind::horizon));
  const PackageReader package(folder.path() / "street.farlod");
  std::vector<PlaceOfReceiver> shifted;
  for (const Point2d p : places()) shifted.push_back({p + horizontal(shift), {}});
  std::vector<float> svf(shifted.size(), -1.0F);
  const SkyEvaluator evaluator(package, {way.engine, SkyWeight::cosine, rays, 0.0});
  for (const auto& [cell, chosen] : places_by_cell(package, shifted))
    evaluator.evaluate(receivers_at(package, cell, shifted, chosen, HeightAbove::ground, 1.5F), svf);
  return svf;
}

void expect_alike(const std::vector<float>& a, const std::vector<float>& b, double most) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) EXPECT_NEAR(a[n], b[n], most) << "receiver " << n;
}

class GridIndependence : public testing::TestWithParam<Way> {};

TEST_P(GridIndependence, MovingTheGridByAPartOfACellChangesNothing) {
  const std::vector<float> unmoved = svf_on(GetParam(), {}, 0.0);
  EXPECT_LT(*std::max_element(unmoved.begin(), unmoved.end()), 0.8F) << "the street hides too little to tell";
  EXPECT_GT(*std::min_element(unmoved.begin(), unmoved.end()), 0.0F);
  for (const Point3d& shift : {Point3d{3.7, -8.1, 0.0}, {10.0, 10.0, 0.0}, {-19.9, 0.013, 0.0}})
    expect_alike(svf_on(GetParam(), shift, 0.0), unmoved, GetParam().allowed_change);
}

TEST_P(GridIndependence, TurningTheGridChangesNothing) {
  const std::vector<float> unturned = svf_on(GetParam(), {}, 0.0);
  for (const double bearing_deg : {12.3, 45.0, 90.0, -77.0})
    expect_alike(svf_on(GetParam(), {}, bearing_deg), unturned, GetParam().allowed_change);
}

TEST_P(GridIndependence, LiftingTheCityChangesNothing) {
  expect_alike(svf_on(GetParam(), {0.0, 0.0, 41.37}, 0.0), svf_on(GetParam(), {}, 0.0), GetParam().allowed_change);
}

TEST(GridIndependence, AzimuthsOfHorizonsAreThoseOfTheCity) {
  // Two azimuths look north and south. In the north stands a house, seen at 45°: half of that azimuth's sky is left
  scenes::SceneBuilder builder;
  builder.add_box({{-5.0, 8.0}, {5.0, 20.0}}, 0.0, 9.5);
  builder.add_box({{30.0, 30.0}, {30.1, 30.1}}, 0.0, 0.01);
  builder.add_box({{-30.0, -30.0}, {-29.9, -29.9}}, 0.0, 0.01);
  for (const double bearing_deg : {0.0, 33.0, -77.0, 180.0}) {
    const Grid grid = scenes::grid_covering(builder.city(), Angle::degrees(bearing_deg), cell_m, 3, 4);
    const scenes::TemporaryFolder folder;
    scenes::pack_city(builder.city(), grid, folder.path() / "house.farlod", scenes::small_maps(FarMapKind::horizon));
    const PackageReader package(folder.path() / "house.farlod");
    SkySettings settings{Engine::horizon};
    settings.azimuths = 2;
    const std::vector<PlaceOfReceiver> place{{{0.0, 0.0}, {}}};
    std::vector<float> svf(1, -1.0F);
    for (const auto& [cell, chosen] : places_by_cell(package, place))
      SkyEvaluator(package, settings).evaluate(receivers_at(package, cell, place, chosen, HeightAbove::ground, 1.5F), svf);
    // A slope of 1 whose coordinates are rounded
    EXPECT_NEAR(svf[0], 0.75, place_error_m / 8.0) << bearing_deg;
  }
}

std::string name_of(const testing::TestParamInfo<Way>& test) {
  return test.param.engine == Engine::rays ? "Rays" : test.param.engine == Engine::exact ? "Exact" : "Automatic";
}

INSTANTIATE_TEST_SUITE_P(Engines, GridIndependence,
                         testing::Values(Way{Engine::rays, 3, allowed_change}, Way{Engine::exact, 3, allowed_change},
                                         Way{Engine::automatic, 15, allowed_change_of_horizons}),
                         name_of);

}  // namespace
}  // namespace farlod
