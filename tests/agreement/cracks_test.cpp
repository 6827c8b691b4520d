// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "horizon/certain_sky.hpp"
#include "tests/preprocess/tiles/bodies.hpp"
#include "tests/scenes/packed_city.hpp"

// Cracks and leans within the tolerances of roles: what the packer counts as closed is closed in the package, so that bounds hold
// its true value.

namespace farlod {
namespace {

using tiles::test::Face;

struct Scene {
  std::string name;
  std::vector<Face> building;
  Point3d eye;
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

/// A roof that rises by 45° to the north, so far above the wall below its eave. All its other borders are free.
std::vector<Face> shelter(double crack_m) {
  return {{{10, 10, 0}, {20, 10, 0}, {20, 10, 2}, {10, 10, 2}},
          {{10, 10, 2 + crack_m}, {20, 10, 2 + crack_m}, {20, 15, 7 + crack_m}, {10, 15, 7 + crack_m}}};
}

/// The same roof above four walls.
std::vector<Face> house_under(double crack_m) {
  std::vector<Face> faces = shelter(crack_m);
  faces.push_back({{20, 10, 0}, {20, 15, 0}, {20, 15, 7}, {20, 10, 2}});
  faces.push_back({{20, 15, 0}, {10, 15, 0}, {10, 15, 7}, {20, 15, 7}});
  faces.push_back({{10, 15, 0}, {10, 10, 0}, {10, 10, 2}, {10, 15, 7}});
  return faces;
}

/// A level roof whose border runs towards the top of a wall, and meets it at an end.
std::vector<Face> wedge_between_roof_and_wall() {
  return {{{10, 10, 0}, {20, 10, 0}, {20, 10, 2}, {10, 10, 2}}, {{20, 10, 2}, {10, 13, 2}, {10, 16, 2}}};
}

/// A closed tower of 20 m whose east wall leans out.
std::vector<Face> tower_leaning_by(double lean_m) {
  const double east = 20 + lean_m;
  return {{{10, 10, 20}, {east, 10, 20}, {east, 18, 20}, {10, 18, 20}}, {{10, 10, 0}, {10, 18, 0}, {20, 18, 0}, {20, 10, 0}},
          {{20, 10, 0}, {20, 18, 0}, {east, 18, 20}, {east, 10, 20}},   {{10, 10, 0}, {10, 10, 20}, {10, 18, 20}, {10, 18, 0}},
          {{10, 10, 0}, {20, 10, 0}, {east, 10, 20}, {10, 10, 20}},     {{10, 18, 0}, {10, 18, 20}, {east, 18, 20}, {20, 18, 0}}};
}

class Cracks : public testing::TestWithParam<Scene> {
 protected:
  struct Svf {
    float estimate = 0.0F, low = 0.0F, high = 0.0F;
  };
  Cracks() : package_(packed()) {}

  [[nodiscard]] Svf svf(Engine engine, std::optional<double> allowed_error = std::nullopt) const {
    const Cell cell = package_.grid().cell_of(horizontal(GetParam().eye));
    const Point2d p = horizontal(GetParam().eye) - package_.grid().corner_of(cell);
    const Point3f p_cell{static_cast<float>(p.x), static_cast<float>(p.y),
                         static_cast<float>(GetParam().eye.z - package_.manifest().height_origin_m)};
    std::vector<float> estimate(1), low(1), high(1);
    SkyEvaluator(package_, {engine, SkyWeight::cosine, 1000, allowed_error, DirectionSet::partition, 320})
        .evaluate({cell, {{0, p_cell}}}, SkyAnswers(estimate, low, high));
    return {estimate[0], low[0], high[0]};
  }

 private:
  [[nodiscard]] PackageReader packed() const {
    CityModel city;
    tiles::test::add_building(city, "stone", tiles::test::box(0, 0, 0.5, 0.5, 0, 0.1));
    tiles::test::add_building(city, "house", GetParam().building);
    scenes::pack_city(city, scenes::grid_covering(city, {}, 50.0, 3), folder_.path() / "house.farlod");
    return PackageReader(folder_.path() / "house.farlod");
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
};

TEST_P(Cracks, AreClosedSoThatBoundsHold) {
  const Svf exact = svf(Engine::exact);
  for (const std::optional<double> allowed : {std::optional<double>{}, std::optional(0.001), std::optional(0.0)}) {
    const Svf bounded = svf(Engine::automatic, allowed);
    EXPECT_LE(bounded.low, exact.high);
    EXPECT_GE(bounded.high, exact.low);
  }
}

/// Where bounds are wide, the whole city decides until they are close to the value, which need not move.
TEST_P(Cracks, AllowedErrorsLeaveValuesAsTheyAre) {
  constexpr double allowed = 0.01;
  const float plain = svf(Engine::automatic).estimate;
  const Svf exact = svf(Engine::exact), bounded = svf(Engine::automatic, allowed);
  ASSERT_NEAR(plain, exact.low, allowed);
  EXPECT_FLOAT_EQ(bounded.estimate, std::clamp(plain, bounded.low, bounded.high));
  EXPECT_LE(bounded.high - plain, allowed + rounding_of_bounds);
  EXPECT_GE(bounded.low - plain, -allowed - rounding_of_bounds);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Cracks,
                         testing::Values(Scene{"AMillimetreBelowARoof", shelter(0.0015), {15, 8, 1}},
                                         Scene{"ACentimetreBelowARoof", shelter(0.015), {15, 8, 1}},
                                         Scene{"InThePlaneOfARoofOnWalls", house_under(0.015), {15, 9, 1.0075}},
                                         Scene{"InThePlaneOfARoofAMillimetreAboveWalls", house_under(0.0015), {15, 9, 1.00075}},
                                         Scene{"BeforeTheEndOfAWedge", wedge_between_roof_and_wall(), {19.7, 10.045, 1.5}},
                                         Scene{"BesideALeaningCorner", tower_leaning_by(0.04), {20.02, 5, 0.5}},
                                         Scene{"BesideACornerThatLeansByMillimetres", tower_leaning_by(0.01), {20.005, 8, 0.5}}),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace farlod
