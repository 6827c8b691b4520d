// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/preprocess/tiles/bodies.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

constexpr double cell_edge_m = 50.0, depth_m = 0.25;

struct Eye {
  std::string name;
  Point3d place;
  Point3f normal;
  bool is_in_recess;
};
void PrintTo(const Eye& eye, std::ostream* out) { *out << eye.name; }

struct Svf {
  float estimate = 0.0F, low = 0.0F, high = 0.0F;
};

/// A house with a window set back, and what stands opposite.
class HouseWithRecess {
 public:
  explicit HouseWithRecess(const std::vector<tiles::test::Face>& opposite = {}) : package_(packed(opposite)) {}

  [[nodiscard]] Svf svf(const Eye& eye, Engine engine, std::optional<double> allowed_error = std::nullopt) const {
    // Another receiver sees the borders that this one faces from below
    const CellReceivers both{cell_, {{0, p_cell(eye.place), eye.normal}, {1, p_cell({12, 5, 1.5})}}};
    std::vector<float> estimate(2), low(2), high(2);
    constexpr std::size_t rays = 20'000;
    SkyEvaluator(package_, {engine, SkyWeight::cosine, rays, allowed_error, DirectionSet::partition, 320})
        .evaluate(both, SkyAnswers(estimate, low, high));
    return {estimate[0], low[0], high[0]};
  }

 private:
  [[nodiscard]] PackageReader packed(const std::vector<tiles::test::Face>& opposite) const {
    CityModel city;
    tiles::test::add_building(city, "stone", tiles::test::box(0, 0, 0.5, 0.5, 0, 0.1));
    tiles::test::add_building(city, "house", tiles::test::house_with_recess(10 + depth_m));
    if (!opposite.empty()) tiles::test::add_building(city, "opposite", opposite);
    scenes::pack_city(city, scenes::grid_covering(city, {}, cell_edge_m, 3), folder_.path() / "house.farlod");
    return PackageReader(folder_.path() / "house.farlod");
  }

  [[nodiscard]] Point3f p_cell(const Point3d& place) const {
    const Point2d p = horizontal(place) - package_.grid().corner_of(cell_);
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(place.z - package_.manifest().height_origin_m)};
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
  Cell cell_ = package_.grid().cell_of({15, 10});
};

TEST(Recesses, TheSkyThroughAWindowIsKnown) {
  // The upper part of the opening, seen from 1 cm before the pane: 1 m to the west, 2 m to the east, and 1 m up
  const Eye eye{"", {15, 10 + depth_m - 0.01, 2}, {0, -1, 0}, true};
  const double expected = oracles::court_quadrant_cos(1, 1, depth_m - 0.01) + oracles::court_quadrant_cos(2, 1, depth_m - 0.01);
  const HouseWithRecess house;
  for (const Engine engine : {Engine::automatic, Engine::rays}) {
    const Svf svf = house.svf(eye, engine);
    EXPECT_NEAR(svf.estimate, expected, 0.005);
    EXPECT_LE(svf.low, expected);
    EXPECT_GE(svf.high, expected);
  }
  EXPECT_NEAR(house.svf(eye, Engine::automatic, 0.0).estimate, expected, 5e-5);
}

class RecessSeen : public testing::TestWithParam<Eye> {};

TEST_P(RecessSeen, IsTheSameByAllEngines) {
  const HouseWithRecess house(tiles::test::box(8, -5, 22, 0, 0, 9));
  const Eye& eye = GetParam();
  const Svf exact = house.svf(eye, Engine::exact);
  for (const Engine engine : {Engine::automatic, Engine::rays}) {
    const Svf svf = house.svf(eye, engine);
    EXPECT_NEAR(svf.estimate, exact.estimate, 0.005);
    EXPECT_LE(svf.low, exact.high);
    EXPECT_GE(svf.high, exact.low);
    // Outside, the border above the window hides all below it
    if (!eye.is_in_recess && engine == Engine::automatic) {
      EXPECT_LT(svf.high - svf.low, 0.02F);
    }
  }
  EXPECT_NEAR(house.svf(eye, Engine::automatic, 0.001).estimate, exact.estimate, 0.001);
}

INSTANTIATE_TEST_SUITE_P(
    Eyes, RecessSeen,
    testing::Values(Eye{"OnThePane", {14.5, 10.24, 2.5}, {0, -1, 0}, true}, Eye{"OnTheSill", {16.8, 10.1, 1.01}, {0, 0, 1}, true},
                    Eye{"OnTheReveal", {14.01, 10.1, 2}, {1, 0, 0}, true},
                    Eye{"BeforeTheWindow", {15, 9.9, 1.5}, {0, 0, 1}, false}, Eye{"InTheStreet", {12, 5, 1.5}, {0, 0, 1}, false},
                    Eye{"OnTheWall", {11, 9.99, 2}, {0, -1, 0}, false}, Eye{"OnTheRoof", {15, 12, 6.01}, {0, 0, 1}, false}),
    [](const auto& param) { return param.param.name; });

TEST(Recesses, EyesRightBelowAWallThatLeansOutSeeThePlaceBeforeIt) {
  // It stands on a pillar, and its south wall leans by so much that counts as upright
  std::vector<tiles::test::Face> hanging = tiles::test::box(8, 3, 22, 8, 3, 9);
  for (tiles::test::Face& face : hanging)
    for (Point3d& p : face)
      if (p.y == 3.0 && p.z == 3.0) p.y += 0.8 * max_lean_m;
  for (const tiles::test::Face& face : tiles::test::box(14, 5, 16, 7, 0, 3)) hanging.push_back(face);
  const HouseWithRecess house(hanging);
  const Eye eye{"", {15, 3.03, 3.2}, {0, -1, 0}, true};
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact})
    EXPECT_NEAR(house.svf(eye, engine).estimate, 0.5, 0.005);
}

}  // namespace
}  // namespace farlod
