// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <tuple>

#include "evaluate/error_budget.hpp"
#include "package/package_folder.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

constexpr double edge_of_cell_m = 20.0;

/// Far maps of the kind `box` know no horizons.
std::vector<Engine> engines_of(FarMapKind kind) {
  if (kind == FarMapKind::box) return {Engine::automatic, Engine::rays, Engine::exact};
  return {Engine::automatic, Engine::horizon, Engine::rays, Engine::exact};
}

Grid grid_of(const CellRange& cells, int neighborhood = 3) {
  Grid grid;
  grid.cell_edge_m = edge_of_cell_m;
  grid.neighborhood = neighborhood;
  grid.block_edge = 4;
  grid.cells = cells;
  return grid;
}

class PackedScene {
 public:
  PackedScene(const CityModel& city, const Grid& grid, FarMapKind kind) : package_(packed(city, grid, kind)) {}

  [[nodiscard]] const PackageReader& package() const { return package_; }
  [[nodiscard]] std::vector<float> svf(const CellReceivers& receivers, const SkySettings& settings) const {
    std::vector<float> result(receivers.receivers.size(), -1.0F);
    SkyEvaluator(package_, settings).evaluate(receivers, result);
    return result;
  }

 private:
  PackageReader packed(const CityModel& city, const Grid& grid, FarMapKind kind) const {
    scenes::pack_city(city, grid, folder_.path() / "scene.farlod", scenes::small_maps(kind));
    return PackageReader(folder_.path() / "scene.farlod");
  }
  scenes::TemporaryFolder folder_;
  PackageReader package_;
};

/// 25 places spread over a cell, at eye height.
CellReceivers spread_over(Cell cell) {
  CellReceivers result{cell, {}};
  for (std::size_t n = 0; n < 25; ++n)
    result.receivers.push_back({n, {1.3F + 4.1F * static_cast<float>(n % 5), 1.7F + 4.1F * static_cast<float>(n / 5), 1.5F}});
  return result;
}

/// An open field: one stone, lower than any eye, says where the ground is.
scenes::SceneBuilder open_field() {
  scenes::SceneBuilder builder;
  builder.add_box({{5.0, 5.0}, {5.1, 5.1}}, 0.0, 0.01);
  return builder;
}

/// Boxes of random size, none of them over the places of `spread_over({0, 0})`.
CityModel random_boxes(int count) {
  std::mt19937_64 random(20120901);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  scenes::SceneBuilder builder = open_field();
  for (int n = 0; n < count; ++n) {
    const Point2d low{between(-58.0, 68.0), between(-58.0, 68.0)};
    const bool near_receivers = low.x < 21.0 && low.x > -7.0 && low.y < 21.0 && low.y > -7.0;
    const double height = between(3.0, 40.0);
    if (!near_receivers) builder.add_box({low, low + Point2d{between(2.0, 6.0), between(2.0, 6.0)}}, 0.0, height);
  }
  return builder.city();
}

constexpr CellRange around_the_middle{-3, -3, 4, 4};

class SkyEvaluatorOfKind : public testing::TestWithParam<FarMapKind> {};

TEST_P(SkyEvaluatorOfKind, AnOpenFieldSeesAllOfTheSky) {
  const PackedScene field(open_field().city(), grid_of({0, 0, 2, 2}), GetParam());
  for (const Engine engine : engines_of(GetParam()))
    for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle})
      for (const std::size_t rays : {1U, 145U, 1000U})
        EXPECT_EQ(field.svf(spread_over({1, 0}), {engine, weight, rays}), std::vector<float>(25, 1.0F));
}

TEST_P(SkyEvaluatorOfKind, AnswersLieBetweenZeroAndOne) {
  const PackedScene town(random_boxes(60), grid_of(around_the_middle), GetParam());
  CellReceivers receivers = spread_over({0, 0});
  for (std::size_t n = 0; n < receivers.receivers.size(); n += 2) {
    const Point3d normal =
        normalized(Point3d{std::sin(1.0 * static_cast<double>(n)), std::cos(2.0 * static_cast<double>(n)), 0.2});
    receivers.receivers[n].normal = {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)};
  }
  for (const Engine engine : engines_of(GetParam()))
    for (const float svf : town.svf(receivers, {engine, SkyWeight::cosine, 290})) EXPECT_TRUE(svf > 0.0F && svf < 1.0F) << svf;
}

TEST_P(SkyEvaluatorOfKind, InAClosedRoomThereIsNoSky) {
  scenes::SceneBuilder builder;
  const std::vector<Point2d> corners{{-1.0, -1.0}, {21.0, -1.0}, {21.0, 21.0}, {-1.0, 21.0}};
  for (std::size_t n = 0; n < 4; ++n) builder.add_wall(corners[n], corners[(n + 1) % 4], 0.0, 5.0);
  builder.add_polygon({{-1.0, -1.0, 5.0}, {21.0, -1.0, 5.0}, {21.0, 21.0, 5.0}, {-1.0, 21.0, 5.0}});
  const PackedScene room(builder.city(), grid_of({-1, -1, 2, 2}), GetParam());
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact})
    EXPECT_EQ(room.svf(spread_over({0, 0}), {engine}), std::vector<float>(25, 0.0F));
}

TEST_P(SkyEvaluatorOfKind, AnotherBuildingNeverOpensTheSky) {
  // A neighborhood that holds the city: what hides the sky is geometry, in both engines
  const Grid all_near = grid_of(around_the_middle, 7);
  for (const Engine engine : engines_of(GetParam())) {
    std::vector<float> before(25, 1.0F);
    for (int count = 0; count <= 60; count += 4) {
      const std::vector<float> after =
          PackedScene(random_boxes(count), all_near, GetParam()).svf(spread_over({0, 0}), {engine, SkyWeight::cosine, 290});
      for (std::size_t n = 0; n < after.size(); ++n) EXPECT_LE(after[n], before[n]) << count << " boxes, receiver " << n;
      before = after;
    }
    EXPECT_LT(*std::max_element(before.begin(), before.end()), 0.95F) << "the boxes hide too little to tell";
  }
}

/// Horizons and rays are told and traced in different ways: a ray that grazes an edge may pass it on either side.
constexpr float one_ray = 1.5F / 1000.0F;

TEST_P(SkyEvaluatorOfKind, WhereAllIsNearTheEnginesAgree) {
  const PackedScene town(random_boxes(60), grid_of(around_the_middle, 7), GetParam());
  const std::vector<float> exact = town.svf(spread_over({0, 0}), {Engine::exact, SkyWeight::cosine, 1000});
  for (const Engine engine : engines_of(GetParam())) {
    const bool by_horizons = GetParam() == FarMapKind::horizon && (engine == Engine::automatic || engine == Engine::horizon);
    const double error = by_horizons ? azimuth_error(256) + sampling_error(1000) : one_ray;
    const std::vector<float> svf = town.svf(spread_over({0, 0}), {engine, SkyWeight::cosine, 1000});
    for (std::size_t n = 0; n < svf.size(); ++n) EXPECT_NEAR(svf[n], exact[n], error) << "receiver " << n;
  }
}

/// By rays of the whole city, or by its horizons where `automatic` and `horizon` draw them.
TEST_P(SkyEvaluatorOfKind, OutsideOfTheGridAnswersAreThoseOfTheWholeCity) {
  const PackedScene town(random_boxes(60), grid_of(around_the_middle, 1), GetParam());
  for (const Cell outside : {Cell{4, 0}, {0, -5}, {-4, 4}})
    for (const Engine engine : engines_of(GetParam())) {
      const std::vector<float> svf = town.svf(spread_over(outside), {engine});
      const std::vector<float> exact = town.svf(spread_over(outside), {Engine::exact});
      const bool has_horizons = GetParam() == FarMapKind::horizon && (engine == Engine::automatic || engine == Engine::horizon);
      const double of_rays = has_horizons ? 0.008 : 0.0;
      for (std::size_t n = 0; n < svf.size(); ++n) EXPECT_NEAR(svf[n], exact[n], of_rays) << n;
      EXPECT_LT(*std::min_element(svf.begin(), svf.end()), 1.0F);
    }
  if (GetParam() == FarMapKind::box) {
    EXPECT_NE(town.svf(spread_over({0, 0}), {Engine::rays}), town.svf(spread_over({0, 0}), {Engine::exact}))
        << "the far map's error should show";
  }
}

TEST_P(SkyEvaluatorOfKind, ATiltedReceiverSharesAllOfItsRays) {
  const PackedScene field(open_field().city(), grid_of({0, 0, 2, 2}), GetParam());
  CellReceivers wall = spread_over({1, 0});
  for (Receiver& r : wall.receivers) r.normal = {0.0F, 1.0F, 0.0F};
  // Half of a wall's rays point below the horizon: they count, and see no sky
  const auto seen = static_cast<float>(SkyDirections(SkyWeight::cosine, 1000, {}).facing({0.0, 1.0, 0.0}).size());
  for (const Engine engine : {Engine::rays, Engine::exact})
    EXPECT_EQ(field.svf(wall, {engine}), std::vector<float>(25, seen / 1000.0F));
  if (GetParam() == FarMapKind::box) return;
  // Horizons see half of the sky, but for the corners of |cos φ|: the midpoint rule errs there by at most the square of a step
  constexpr double step = 2.0 * std::numbers::pi / 256;
  for (const float svf : field.svf(wall, {Engine::automatic})) EXPECT_NEAR(svf, 0.5, step * step);
}

TEST_P(SkyEvaluatorOfKind, WhatIsFarHidesTheSkyToo) {
  scenes::SceneBuilder builder = open_field();
  builder.add_box({{-55.0, -55.0}, {-45.0, 75.0}}, 0.0, 60.0);
  const PackedScene town(builder.city(), grid_of(around_the_middle, 1), GetParam());
  // At the capture point, the map is wrong by its texels only; the wall hides an eighth of the sky
  const CellReceivers middle{{0, 0}, {{0, {10.0F, 10.0F, 1.5F}}}};
  constexpr std::size_t many = 100000;
  const float rays = town.svf(middle, {Engine::rays, SkyWeight::cosine, many})[0];
  const float exact = town.svf(middle, {Engine::exact, SkyWeight::cosine, many})[0];
  EXPECT_LT(exact, 0.9F);
  if (GetParam() == FarMapKind::horizon) {
    // A single wall is explicit, and seen without any error but that of rounding: a ray may pass it on the other side
    EXPECT_NEAR(rays, exact, 1.5 / many);
    return;
  }
  const BoxMap shape = town.package().box_far_map({0, 0}).shape();
  EXPECT_NEAR(rays, exact, box_map_error(shape, 2 * shape.top, steepest_cos) + 2 * sampling_error(many, 4 * std::numbers::pi));
}

TEST_P(SkyEvaluatorOfKind, AnswersGoWhereTheirIndexSays) {
  const PackedScene town(random_boxes(60), grid_of(around_the_middle), GetParam());
  CellReceivers receivers = spread_over({0, 0});
  const std::vector<float> in_order = town.svf(receivers, {});
  std::vector<float> spaced(100, -1.0F);
  for (Receiver& r : receivers.receivers) r.index = 99 - 4 * r.index;
  SkyEvaluator(town.package(), {}).evaluate(receivers, spaced);
  for (std::size_t n = 0; n < 100; ++n) EXPECT_EQ(spaced[n], n % 4 == 3 ? in_order[(99 - n) / 4] : -1.0F);
}

TEST_P(SkyEvaluatorOfKind, NoReceiversNoWork) {
  const PackedScene field(open_field().city(), grid_of({0, 0, 1, 1}), GetParam());
  EXPECT_TRUE(field.svf({{0, 0}, {}}, {}).empty());
}

/// A field with a slab over the west of it, on one post.
CityModel under_a_slab() {
  scenes::SceneBuilder builder = open_field();
  builder.add_box({{-20.0, 8.0}, {-19.0, 9.0}}, 0.0, 6.0);
  builder.add_polygon({{-30.0, 0.0, 6.0}, {-10.0, 0.0, 6.0}, {-10.0, 20.0, 6.0}, {-30.0, 20.0, 6.0}});
  // High houses hide the slab from the places behind them
  builder.add_box({{-9.0, -10.0}, {-5.0, 30.0}}, 0.0, 40.0);
  return builder.city();
}

TEST(SkyEvaluatorByHorizons, TellWhatIsSeenBelowSomethingWithoutRays) {
  const PackedScene scene(under_a_slab(), grid_of({-3, -3, 4, 4}, 7), FarMapKind::horizon);
  for (const Cell cell : {Cell{-2, 0}, Cell{0, 0}}) {
    const SkyEvaluator automatic(scene.package(), {Engine::automatic}), rays(scene.package(), {Engine::rays});
    std::vector<float> a(25), b(25);
    automatic.evaluate(spread_over(cell), a);
    rays.evaluate(spread_over(cell), b);
    for (std::size_t n = 0; n < a.size(); ++n)
      EXPECT_NEAR(a[n], b[n], sampling_error_of({Engine::automatic}) + sampling_error_of({Engine::rays})) << n;
    EXPECT_EQ(automatic.statistics().by_rays, 0U);
    EXPECT_EQ(rays.statistics().by_rays, 25U);
    EXPECT_EQ(scene.svf(spread_over(cell), {Engine::horizon}), a) << "the same engine, where there is a far map";
  }
}

TEST(SkyEvaluatorByHorizons, WithMapsOfTheKindBoxAutomaticIsRays) {
  const PackedScene town(random_boxes(60), grid_of(around_the_middle), FarMapKind::box);
  EXPECT_EQ(town.svf(spread_over({0, 0}), {Engine::automatic}), town.svf(spread_over({0, 0}), {Engine::rays}));
}

TEST(SkyEvaluatorByHorizons, MoreAzimuthsComeNearer) {
  const PackedScene town(random_boxes(60), grid_of(around_the_middle, 7), FarMapKind::horizon);
  constexpr std::size_t many = 100000;
  const std::vector<float> exact = town.svf(spread_over({0, 0}), {Engine::exact, SkyWeight::cosine, many});
  const auto largest_error = [&](std::size_t azimuths) {
    SkySettings settings{Engine::horizon};
    settings.azimuths = azimuths;
    const std::vector<float> svf = town.svf(spread_over({0, 0}), settings);
    double largest = 0.0;
    for (std::size_t n = 0; n < svf.size(); ++n) largest = std::max<double>(largest, std::abs(svf[n] - exact[n]));
    return largest;
  };
  // An error falls with the number of azimuths, at the least: sixteen times as many, a quarter of it leaves room for luck
  EXPECT_LT(largest_error(1024), largest_error(64) / 4.0 + sampling_error(many));
  EXPECT_LT(largest_error(4096), largest_error(256) / 4.0 + sampling_error(many));
}

TEST(SkyEvaluatorByHorizons, ReceiversThatLookManyWaysMayComeInAnyOrder) {
  const PackedScene scene(under_a_slab(), grid_of({-3, -3, 4, 4}, 7), FarMapKind::horizon);
  CellReceivers receivers = spread_over({-1, 0});
  std::mt19937_64 random(20120901);
  for (Receiver& r : receivers.receivers) {
    const auto kind = random() % 3;
    r.normal = kind == 0 ? Point3f{0.0F, 0.0F, 1.0F} : kind == 1 ? Point3f{1.0F, 0.0F, 0.0F} : Point3f{0.0F, -0.6F, 0.8F};
  }
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
    const std::vector<float> in_order = scene.svf(receivers, {engine});
    CellReceivers turned = receivers;
    std::reverse(turned.receivers.begin(), turned.receivers.end());
    EXPECT_EQ(scene.svf(turned, {engine}), in_order);
  }
}

INSTANTIATE_TEST_SUITE_P(SkyEvaluator, SkyEvaluatorOfKind, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

}  // namespace
}  // namespace farlod
