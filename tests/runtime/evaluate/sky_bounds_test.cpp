// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include "evaluate/sky_evaluator.hpp"
#include "horizon/certain_sky.hpp"
#include "receivers/point_receivers.hpp"
#include "receivers/receiver.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/packed_once.hpp"
#include "tests/scenes/scene_builder.hpp"

// What the far map of the kind `horizon` promises of whole answers, in towns with everything that hides the sky: towers, roofs,
// bridges that can be seen under, hills.

namespace farlod {
namespace {

constexpr std::size_t bounded_rays = 1000;
/// The near scene and the whole city round to floats in frames of their own: a ray that grazes an edge may pass it on either
/// side.
constexpr double one_bounded_ray = 1.5 / static_cast<double>(bounded_rays);

struct Town {
  const char* name;
  double cell_m;
  int neighborhood;
  double tower_share, relief_m;
  bool overhangs;
  double tolerance;
  Assign assign = Assign::clip;
};
void PrintTo(const Town& town, std::ostream* out) { *out << town.name; }

CityModel city_of(const Town& town) {
  CitySettings settings{.size_m = 400,
                        .rotation_deg = 13,
                        .tower_share = town.tower_share,
                        .terrain_relief_m = town.relief_m,
                        .lod = 2,
                        .overhangs = town.overhangs};
  return scenes::generated_town(settings);
}

struct Answers {
  std::vector<float> svf, low, high;
};

class SkyBounds : public testing::TestWithParam<Town> {
 protected:
  SkyBounds() : package_(packed()), places_(some_places()) {}

  static bool pack(const std::filesystem::path& folder) {
    const Town& town = GetParam();
    const CityModel city = city_of(town);
    const Grid grid = scenes::grid_covering(city, Angle::degrees(13.0), town.cell_m, town.neighborhood, 4);
    FarMapSettings settings;
    settings.horizon.tolerance = town.tolerance;
    scenes::pack_city(city, grid, folder / "town.farlod", settings, town.assign);
    return true;
  }
  static std::filesystem::path packed() {
    return scenes::packed_once({std::string("bounds_") + GetParam().name, "", scenes::this_program()}, pack) / "town.farlod";
  }

  /// All over the town, on streets and roofs and high above both, a fifth of them tilted; none inside of a building.
  std::vector<CellReceivers> some_places() {
    const Grid& grid = package_.grid();
    std::vector<CellReceivers> places;
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
      const PointLocator locator(package_, grid.cells.cell_at(n));
      CellReceivers cell{grid.cells.cell_at(n), {}};
      const auto add = [&](float x, HeightAbove above, float height_m, const Point3f& normal) {
        const auto p = stand(locator, x, between(0, grid.cell_edge_m), above, height_m);
        if (p) cell.receivers.push_back({count_++, *p, normal});
      };
      const auto edge = grid.cell_edge_m;
      for (const float height_m : {1.5F, 12.0F, 60.0F}) add(between(0, edge), HeightAbove::ground, height_m, upwards);
      add(between(0, edge), HeightAbove::highest_surface, 0.3F, upwards);
      // Where squares and cells meet
      add(0.0F, HeightAbove::ground, 1.5F, upwards);
      add(static_cast<float>(0.5 * edge), HeightAbove::ground, 1.5F, normalized(Point3f{between(-1, 1), between(-1, 1), 0.5F}));
      places.push_back(std::move(cell));
    }
    return places;
  }

  float between(double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53);
  }

  [[nodiscard]] Answers answers(Engine engine, std::optional<double> allowed_error = std::nullopt,
                                bool of_same_rays = false) const {
    SkySettings settings{engine, SkyWeight::cosine, bounded_rays, allowed_error};
    settings.bounds_of_same_rays = of_same_rays;
    const SkyEvaluator evaluator(package_, settings);
    Answers a{std::vector<float>(count_), std::vector<float>(count_), std::vector<float>(count_)};
    for (const CellReceivers& cell : places_) evaluator.evaluate(cell, SkyAnswers(a.svf, a.low, a.high));
    return a;
  }

  static constexpr Point3f upwards{0.0F, 0.0F, 1.0F};
  std::mt19937_64 random_{20120901};
  std::size_t count_ = 0;
  PackageReader package_;
  std::vector<CellReceivers> places_;
};

/// Bounds are in order, and hold the true values. Returns how wide the widest are.
double expect_held(const Answers& bounded, const Answers& exact) {
  double widest = 0.0;
  for (std::size_t n = 0; n < exact.svf.size(); ++n) {
    EXPECT_LE(bounded.low[n], exact.svf[n]) << "receiver " << n;
    EXPECT_GE(bounded.high[n], exact.svf[n]) << "receiver " << n;
    EXPECT_LE(bounded.low[n], bounded.svf[n]);
    EXPECT_LE(bounded.svf[n], bounded.high[n]);
    widest = std::max<double>(widest, bounded.high[n] - bounded.low[n]);
  }
  return widest;
}

constexpr double float_rounding = 1e-6;  // of floats up to 1, and of sums of them

TEST_P(SkyBounds, HoldTheTrueValue) {
  const Answers exact = answers(Engine::exact);
  EXPECT_EQ(exact.low, exact.high);
  EXPECT_LT(*std::min_element(exact.svf.begin(), exact.svf.end()), 0.5F) << "the town hides too little to tell";
  EXPECT_GT(expect_held(answers(Engine::rays), exact), 0.0);
  // Horizons alone cannot do where something hangs
  expect_held(answers(Engine::automatic), exact);
  if (!GetParam().overhangs) expect_held(answers(Engine::horizon), exact);
}

TEST_P(SkyBounds, OfTheSameRaysHoldWhatTheyFind) {
  const Answers exact = answers(Engine::exact, std::nullopt, true), bounded = answers(Engine::rays, std::nullopt, true);
  for (std::size_t n = 0; n < exact.svf.size(); ++n) {
    EXPECT_LE(bounded.low[n], exact.svf[n] + one_bounded_ray) << "receiver " << n;
    EXPECT_GE(bounded.high[n], exact.svf[n] - one_bounded_ray) << "receiver " << n;
  }
}

TEST_P(SkyBounds, KeepAnAllowedError) {
  const Answers exact = answers(Engine::exact);
  for (const Engine engine : {Engine::rays, Engine::automatic})
    for (const double most : {0.0, 0.0005, 0.005}) {
      const Answers some = answers(engine, most);
      const double error = std::max(most, 2.0 * rounding_of_bounds) + float_rounding;
      for (std::size_t n = 0; n < exact.svf.size(); ++n) {
        EXPECT_NEAR(some.svf[n], exact.svf[n], error) << "receiver " << n;
        EXPECT_LE(some.high[n] - some.svf[n], error) << "receiver " << n;
        EXPECT_LE(some.svf[n] - some.low[n], error) << "receiver " << n;
      }
      expect_held(some, exact);
    }
}

TEST_P(SkyBounds, AskingForThemKeepsAnswersWithinThem) {
  for (const Engine engine : {Engine::rays, Engine::automatic}) {
    const Answers bounded = answers(engine);
    const SkyEvaluator evaluator(package_, {engine, SkyWeight::cosine, bounded_rays});
    std::vector<float> plain(bounded.svf.size());
    for (const CellReceivers& cell : places_) evaluator.evaluate(cell, plain);
    for (std::size_t n = 0; n < plain.size(); ++n)
      EXPECT_EQ(bounded.svf[n], std::clamp(plain[n], bounded.low[n], bounded.high[n])) << "receiver " << n;
  }
}

TEST_P(SkyBounds, TheWholeCityDecidesOnlyWhatItMust) {
  const auto decided_for = [&](Engine engine, double most) {
    const SkyEvaluator evaluator(package_, {engine, SkyWeight::cosine, bounded_rays, most});
    std::vector<float> svf(count_);
    for (const CellReceivers& cell : places_) evaluator.evaluate(cell, svf);
    return evaluator.statistics().retraced_rays;
  };
  for (const Engine engine : {Engine::rays, Engine::automatic}) {
    EXPECT_EQ(decided_for(engine, 1.0), 0U);
    const std::uint64_t all = decided_for(engine, 0.0);
    EXPECT_GT(all, 0U);
    EXPECT_LE(decided_for(engine, 0.005), all / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Towns, SkyBounds,
    testing::Values(Town{"Plain", 50, 3, 0.0, 0.0, false, 0.05}, Town{"Towers", 50, 3, 1.0, 0.0, false, 0.05},
                    Town{"Bridges", 50, 3, 0.3, 0.0, true, 0.05}, Town{"BridgesOverHills", 50, 3, 0.3, 60.0, true, 0.05},
                    Town{"BridgesWholeBuildings", 50, 3, 0.3, 0.0, true, 0.05, Assign::whole},
                    Town{"SmallNeighborhood", 100, 1, 0.5, 20.0, true, 0.05}, Town{"CoarseMap", 50, 3, 0.5, 0.0, true, 0.5},
                    Town{"FineMap", 50, 3, 0.5, 0.0, true, 0.0}),
    [](const auto& test) { return test.param.name; });

// Where the grid happens to lie must not show in the exact answers: neither of the engine that traces all, nor of the one that
// traces only what the far map leaves open, nor of horizons.

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
