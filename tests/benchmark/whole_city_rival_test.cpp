// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/whole_city_rival.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "benchmark/contest.hpp"
#include "evaluate/sky_directions.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod::benchmark {
namespace {

constexpr std::size_t rays = 500;
/// A ray that grazes an edge may go either way: the one scene is robust, the other is not.
constexpr float few_rays = 3.0F / rays;

class Town : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    CitySettings settings;
    settings.size_m = 200.0;
    settings.lod = 2;
    settings.overhangs = true;
    const CityModel city = scenes::generated_town(settings);
    folder = std::make_unique<scenes::TemporaryFolder>();
    scenes::pack_city(city, scenes::grid_covering(city, {}, 50.0, 3), folder->path() / "town.farlod",
                      scenes::small_maps(FarMapKind::horizon));
    town = std::make_unique<City>(folder->path() / "town.farlod");
  }
  static void TearDownTestSuite() {
    town.reset();
    folder.reset();
  }
  static CityReceivers receivers_at(Place place) {
    return place_receivers(town->package, spread_cells(town->package.grid(), 6), place, 5.0);
  }
  static std::vector<float> rival_answers(const WholeCityRival& rival, const CityReceivers& receivers) {
    const SkyDirections all(SkyWeight::cosine, rays, town->package.grid().rotation);
    std::vector<float> svf(receivers.count, -1.0F);
    rival.evaluate(packets_of(town->package.grid(), receivers), {all.facing_up().begin(), all.facing_up().end()}, svf);
    return svf;
  }
  static std::unique_ptr<scenes::TemporaryFolder> folder;
  static std::unique_ptr<City> town;
};
std::unique_ptr<scenes::TemporaryFolder> Town::folder;
std::unique_ptr<City> Town::town;

class RivalAt : public Town, public testing::WithParamInterface<Place> {};

TEST_P(RivalAt, AnswersAsTheExactEngineWithTheSameDirections) {
  const CityReceivers receivers = receivers_at(GetParam());
  ASSERT_GT(receivers.count, 50U);
  const std::vector<float> exact = exact_answers(town->package, receivers, rays), rival = rival_answers(town->rival, receivers);
  for (std::size_t n = 0; n < receivers.count; ++n) EXPECT_NEAR(rival[n], exact[n], few_rays);
}
INSTANTIATE_TEST_SUITE_P(WholeCity, RivalAt, testing::Values(Place::ground, Place::roofs, Place::walls), [](const auto& place) {
  return place.param == Place::ground ? "Ground" : place.param == Place::roofs ? "Roofs" : "Facades";
});

TEST_F(Town, VariantsOfTheRivalAgree) {
  const CityReceivers receivers = receivers_at(Place::walls);
  RivalVariant other;
  other.packets = other.coherent = false;
  other.ends_above_city = other.robust = other.high_quality = true;
  other.order = DirectionOrder::as_given;
  const std::vector<float> one = rival_answers(town->rival, receivers);
  const std::vector<float> two = rival_answers(WholeCityRival(town->triangles, other), receivers);
  for (std::size_t n = 0; n < receivers.count; ++n) EXPECT_NEAR(one[n], two[n], few_rays);
}

TEST_F(Town, ChosenReceiversAreSomeOfAll) {
  const CityReceivers all = receivers_at(Place::ground), some = choose_receivers(all, 20);
  ASSERT_EQ(some.count, 20U);
  const std::vector<float> svf = rival_answers(town->rival, all), some_svf = rival_answers(town->rival, some);
  for (const CellReceivers& cell : some.cells)
    for (const Receiver& r : cell.receivers) {
      const auto of_all = std::find_if(all.cells.begin(), all.cells.end(), [&](const auto& c) { return c.cell == cell.cell; });
      const auto same =
          std::find_if(of_all->receivers.begin(), of_all->receivers.end(), [&](const auto& o) { return o.p_cell == r.p_cell; });
      ASSERT_NE(same, of_all->receivers.end());
      EXPECT_EQ(some_svf[r.index], svf[same->index]);
    }
}

TEST(RivalDirections, HaveTheViewFactorsOfTiltedOpenReceivers) {
  // Cells of equal view factor: how many lie above a tilted receiver's horizon is its view factor, up to those on the border
  constexpr std::size_t count = 4096;
  const std::vector<Point3d> directions = fibonacci_directions(count);
  for (const double tilt : {0.0, 0.5, 1.0, 1.5}) {
    const Point3f normal{static_cast<float>(std::sin(tilt)), 0.0F, static_cast<float>(std::cos(tilt))};
    const double share = static_cast<double>(directions_around(directions, normal).size()) / count;
    EXPECT_NEAR(share, 0.5 * (1.0 + std::cos(tilt)), 2.0 / std::sqrt(count));
  }
}

}  // namespace
}  // namespace farlod::benchmark
