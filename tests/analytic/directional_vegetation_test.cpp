// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "evaluate/sky_evaluator.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "tests/scenes/scene_builder.hpp"

// svfveg and svfaveg of the halves of the sky, against closed forms: a hedge to the east, in the open and in front of a wall.

namespace farlod {
namespace {

using Columns = std::map<std::string, double>;

constexpr float hedge_eye_m = 1.5F;
/// The hedge, seen from the origin: where it begins, how wide it is, between which heights above the eye, and how far it goes.
constexpr double near_m = 6.0, width_m = 2.0, bottom_m = 1.5, top_m = 7.0, end_m = 90.0;
/// The share of the view between its bottom and its top, which lies in the eastern half alone.
const double hidden = 0.5 * (std::cos(std::atan(bottom_m / (near_m + width_m))) - std::cos(std::atan(top_m / near_m)));
/// Beyond its ends an endless one has slopes below .08 within .14 of the azimuths in radians; rays and azimuths err by less.
constexpr double hedge_tolerance = 0.003;
/// With horizons, what is solid is asked of 640 rays, whose error is 2.4 · 640^(−3/4) at the most; a third of it. A half of the
/// sky counts twice.
constexpr double tolerance_of_rays = 0.0063;

constexpr std::array engines_of_crowns{Engine::automatic, Engine::horizon, Engine::rays, Engine::exact};

class HedgeToTheEast {
 public:
  HedgeToTheEast(Angle grid_bearing, bool has_wall) : package_(packed(grid_bearing, has_wall)) {}

  /// Of a receiver at the origin.
  [[nodiscard]] Columns columns(Engine engine, CanopyRule rule = CanopyRule::once) const {
    SkySettings settings{.engine = engine, .rays = 20000};
    settings.further.svf_total = settings.further.svfaveg = settings.further.directional_vegetation = true;
    settings.further.canopy.rule = rule;
    const Point2d p_grid = package_.grid().rotation.grid_from_city(Point2d{});
    const Cell cell = package_.grid().cell_of(p_grid);
    const Point2d p_cell = p_grid - package_.grid().corner_of(cell);
    const CellReceivers receivers{cell,
                                  {{0,
                                    {static_cast<float>(p_cell.x), static_cast<float>(p_cell.y),
                                     static_cast<float>(hedge_eye_m - package_.manifest().height_origin_m)}}}};
    const SkyEvaluator evaluator(package_, settings);
    std::vector<float> svf(1), values(evaluator.further_columns());
    evaluator.evaluate(receivers, SkyAnswers(svf, {}, {}, values));
    Columns named{{"svf", svf.front()}};
    const std::vector<std::string> names = columns_of(settings.further);
    for (std::size_t n = 0; n < names.size(); ++n) named[names[n]] = static_cast<double>(values[n]);
    return named;
  }

 private:
  [[nodiscard]] PackageReader packed(Angle grid_bearing, bool has_wall) const {
    scenes::SceneBuilder builder;
    for (const double side : {-1.0, 1.0})
      builder.add_box({{side * 100.0, side * 100.0}, {side * 100.0 + 0.1, side * 100.0 + 0.1}}, 0.0, 0.01);
    if (has_wall) builder.add_wall({12.0, -99.0}, {12.0, 99.0}, 0.0, 30.0);
    const Grid grid = scenes::grid_covering(builder.city(), grid_bearing, 100.0, 3, 4);
    const std::filesystem::path folder = folder_.path() / "hedge.farlod";
    scenes::pack_city(builder.city(), grid, folder);
    CrownsOfCity crowns = scenes::crowns_for(folder);
    for (double y = -end_m; y <= end_m; y += width_m)
      crowns.add(grid.rotation.grid_from_city(Point2d{near_m + 0.5 * width_m, y}), hedge_eye_m + bottom_m, hedge_eye_m + top_m,
                 0.5 * width_m, CrownShape::prism, Foliage::unknown,
                 std::fmod(4.0 * std::numbers::pi + grid_bearing.radians(), 0.5 * std::numbers::pi));
    scenes::plant(crowns, folder);
    return PackageReader(folder);
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
};

void expect_opposite_halves_to_add_up(const Columns& got) {
  for (const std::string kind : {"veg", "aveg"}) {
    EXPECT_NEAR(0.5 * (got.at("svfN" + kind) + got.at("svfS" + kind)), got.at("svf" + kind), 1e-6) << kind;
    EXPECT_NEAR(0.5 * (got.at("svfE" + kind) + got.at("svfW" + kind)), got.at("svf" + kind), 1e-6) << kind;
  }
}

/// What is hidden lies to the east, and is the same to the north and to the south.
void expect_hidden_to_the_east(const Columns& got, const std::string& kind, double error) {
  EXPECT_NEAR(got.at("svf" + kind), 1.0 - hidden, error) << kind;
  EXPECT_NEAR(got.at("svfE" + kind), 1.0 - 2.0 * hidden, 2.0 * error) << kind;
  EXPECT_NEAR(got.at("svfN" + kind), 1.0 - hidden, 2.0 * error) << kind;
  EXPECT_NEAR(got.at("svfS" + kind), 1.0 - hidden, 2.0 * error) << kind;
  EXPECT_NEAR(got.at("svfW" + kind), 1.0, hedge_tolerance) << kind;
}

void expect_nothing_hidden(const Columns& got, const std::string& kind) {
  for (const char* half : {"", "N", "E", "S", "W"})
    EXPECT_NEAR(got.at(std::string("svf") + half + kind), 1.0, hedge_tolerance) << half;
}

TEST(DirectionalVegetation, OfAHedgeInTheOpenIsKnown) {
  for (const double bearing_deg : {0.0, 20.0}) {
    const HedgeToTheEast scene(Angle::degrees(bearing_deg), /*has_wall=*/false);
    for (const Engine engine : engines_of_crowns) {
      SCOPED_TRACE(std::to_string(bearing_deg) + ", engine " + std::to_string(static_cast<int>(engine)));
      const Columns got = scene.columns(engine);
      expect_hidden_to_the_east(got, "veg", hedge_tolerance);
      expect_nothing_hidden(got, "aveg");
      expect_opposite_halves_to_add_up(got);
    }
  }
}

TEST(DirectionalVegetation, OfAHedgeBeforeAWallIsKnown) {
  const HedgeToTheEast scene(Angle::degrees(20.0), /*has_wall=*/true);
  for (const Engine engine : engines_of_crowns) {
    SCOPED_TRACE("engine " + std::to_string(static_cast<int>(engine)));
    const Columns got = scene.columns(engine);
    expect_nothing_hidden(got, "veg");
    expect_hidden_to_the_east(got, "aveg", engine == Engine::exact ? hedge_tolerance : tolerance_of_rays);
    expect_opposite_halves_to_add_up(got);
  }
}

TEST(DirectionalVegetation, IsTheSameByAllRules) {
  const HedgeToTheEast scene(Angle::degrees(20.0), /*has_wall=*/false);
  for (const CanopyRule rule : {CanopyRule::each, CanopyRule::beer}) {
    const Columns got = scene.columns(Engine::automatic, rule);
    expect_hidden_to_the_east(got, "veg", hedge_tolerance);
    expect_opposite_halves_to_add_up(got);
  }
}

}  // namespace
}  // namespace farlod
