// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "evaluate/sky_evaluator.hpp"
#include "package/package_error.hpp"
#include "tests/analytic/analytic_scenes.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// Every scene with a known answer goes the whole way, from facets to a package and back, with all of its geometry near,
// all of it in the far map, and some of it in each; with walls that are mere sheets and with houses that stand; on all engines,
// with far maps of both kinds; on grids that are turned three ways.

namespace farlod {
namespace {

using analytic::eye_m;
using analytic::ground;
using analytic::Scene;
using analytic::Stage;
using analytic::Walls;
using scenes::SceneBuilder;

constexpr std::size_t rays = 200000, azimuths = 4096;

FarMapSettings maps_of(FarMapKind kind) { return kind == FarMapKind::box ? scenes::box_maps(256, 256) : FarMapSettings{}; }

enum class Share { all_near, all_far, split };

struct Setup {
  Share share;
  Engine engine;
  FarMapKind kind;
  double bearing_deg;
  Walls walls = Walls::sheets;

  [[nodiscard]] bool asks_for_horizons() const { return engine == Engine::automatic || engine == Engine::horizon; }
};

/// The edge of a cell that holds all, nothing or some of the scene around its middle: a corner is √½ of the edge away.
double cell_edge_for(const Scene& scene, Share share) {
  switch (share) {
    case Share::all_near:
      return 3.0 * scene.farthest_m;
    case Share::all_far:
      return 1.2 * scene.nearest_m;
    case Share::split:
      break;
  }
  return 2.0 * std::sqrt(scene.nearest_m * scene.farthest_m);
}

CityModel city_of(const Scene& scene, Walls walls, double cell_edge_m, const GridRotation& rotation) {
  const Point2d middle_city = rotation.city_from_grid(Point2d{0.5 * cell_edge_m, 0.5 * cell_edge_m});
  SceneBuilder builder({middle_city.x, middle_city.y, eye_m});
  Stage stage(builder, walls);
  scene.build(stage);
  // A stone under the eye: it says where the ground is, and that the cell exists
  builder.add_box({{-0.05, -0.05}, {0.05, 0.05}}, ground, ground + 0.01);
  return builder.city();
}

/// A scene on disk, and the receiver in the middle of its cell.
class PackedScene {
 public:
  PackedScene(const Scene& scene, const Setup& setup) : package_(packed(scene, setup)) {
    const auto half = static_cast<float>(0.5 * package_.grid().cell_edge_m);
    const Point3d n = package_.grid().rotation.grid_from_city(scene.normal);
    receiver_ = {{0, 0},
                 {{0,
                   {half, half, static_cast<float>(eye_m - package_.manifest().height_origin_m)},
                   {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}}}};
  }
  struct Svf {
    double estimate, low, high;
  };
  [[nodiscard]] Svf evaluate(Engine engine, SkyWeight weight, std::optional<double> max_far_error = std::nullopt) const {
    std::vector<float> estimate(1), low(1), high(1);
    SkyEvaluator(package_, {engine, weight, rays, max_far_error, DirectionSet::partition, azimuths})
        .evaluate(receiver_, SkyAnswers(estimate, low, high));
    return {estimate[0], low[0], high[0]};
  }
  [[nodiscard]] const PackageReader& package() const { return package_; }

 private:
  PackageReader packed(const Scene& scene, const Setup& setup) const {
    const double cell_edge_m = exact_cell_edge_m(cell_edge_for(scene, setup.share));
    const Angle bearing = Angle::degrees(setup.bearing_deg);
    const CityModel city = city_of(scene, setup.walls, cell_edge_m, GridRotation(bearing));
    const Grid grid = scenes::grid_covering(city, bearing, cell_edge_m, 1, 1);
    scenes::pack_city(city, grid, folder_.path() / "scene.farlod", maps_of(setup.kind), Assign::clip, {{Cell{0, 0}}});
    return PackageReader(folder_.path() / "scene.farlod");
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
  CellReceivers receiver_;
};

/// The border of the sky is no longer than the circle twice over: once along the horizon, once up and down its jumps.
double allowed_sampling(const Scene& scene) { return sampling_error(rays, 4 * std::numbers::pi) + scene.extra_error; }

/// The mean of a function over the circle, from the middles of equal parts, errs in each part by its variation there at the most:
/// altogether by the total variation over their number. What an azimuth gives changes with tan β by at most `steepest` (by 2
/// where the receiver is tilted: twice the cosine to its normal), and with the normal twice from nothing to all: at most 1 + π/2
/// (1).
double azimuth_error_of(const Scene& scene, SkyWeight weight) {
  const bool is_tilted = scene.normal.z < 1.0, is_cosine = weight == SkyWeight::cosine;
  const double steepest = is_cosine ? (is_tilted ? 2.0 : steepest_cos) : steepest_solid;
  const double all = is_cosine ? 1.0 + 0.5 * std::numbers::pi : 1.0;
  return (steepest * scene.rise + (is_tilted ? 2.0 * all : 0.0)) / static_cast<double>(azimuths) + scene.extra_error;
}

/// Where rays stand in for a horizon, theirs is the error.
double allowed_error(const Scene& scene, const Setup& setup, SkyWeight weight) {
  const double by_rays = allowed_sampling(scene);
  return setup.asks_for_horizons() ? std::max(by_rays, azimuth_error_of(scene, weight)) : by_rays;
}

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};

double known_answer(const Scene& scene, SkyWeight weight) {
  return weight == SkyWeight::cosine ? scene.svf_cos : scene.svf_solid;
}

class AnalyticScene : public testing::TestWithParam<std::tuple<Scene, Setup>> {};

TEST_P(AnalyticScene, HasItsKnownSkyViewFactor) {
  const auto& [scene, setup] = GetParam();
  if (setup.kind == FarMapKind::box && setup.share == Share::all_far && scene.is_overhead)
    GTEST_SKIP() << "from below, a roof has no horizon whose texels could be counted";
  const PackedScene packed(scene, setup);
  for (const SkyWeight weight : both_weights) {
    const double expected = known_answer(scene, weight);
    if (std::isnan(expected)) continue;
    // What the far map of the kind `horizon` leaves open is traced: its own error is nothing
    const bool retraces = setup.engine != Engine::exact && setup.kind == FarMapKind::horizon;
    const double svf = packed.evaluate(setup.engine, weight, retraces ? std::optional(0.0) : std::nullopt).estimate;
    const double steepest = weight == SkyWeight::cosine ? steepest_cos : steepest_solid;
    double tolerance = allowed_error(scene, setup, weight);
    if (setup.engine == Engine::rays && setup.kind == FarMapKind::box && setup.share != Share::all_near)
      tolerance += box_map_error(packed.package().box_far_map({0, 0}).shape(), scene.rise, steepest);
    EXPECT_NEAR(svf, expected, tolerance) << (weight == SkyWeight::cosine ? "cosine" : "solid angle");
  }
}

class AnalyticBounds : public AnalyticScene {};

TEST_P(AnalyticBounds, HoldTheKnownSkyViewFactor) {
  const auto& [scene, setup] = GetParam();
  const PackedScene packed(scene, setup);
  for (const SkyWeight weight : both_weights) {
    const double expected = known_answer(scene, weight);
    if (std::isnan(expected)) continue;
    const auto [estimate, low, high] = packed.evaluate(setup.engine, weight);
    EXPECT_LE(low, estimate);
    EXPECT_LE(estimate, high);
    EXPECT_LE(low, expected + allowed_error(scene, setup, weight));
    EXPECT_GE(high, expected - allowed_error(scene, setup, weight));
    // Only what is far, or overhangs, leaves anything open
    if (setup.share == Share::all_near && !scene.is_overhead) {
      EXPECT_EQ(low, high);
    }
  }
}

class AnalyticRefusal : public AnalyticScene {};

TEST_P(AnalyticRefusal, HorizonsAloneCannotDo) {
  const auto& [scene, setup] = GetParam();
  const PackedScene packed(scene, setup);
  for (const SkyWeight weight : both_weights) EXPECT_THROW((void)packed.evaluate(setup.engine, weight), PackageUnusable);
}

const char* name_of(Engine engine) {
  switch (engine) {
    case Engine::automatic:
      return "Automatic";
    case Engine::horizon:
      return "Horizons";
    case Engine::rays:
      return "Rays";
    case Engine::exact:
    case Engine::near_only:
      break;
  }
  return "Exact";
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<Scene, Setup>>& info) {
  const auto& [scene, setup] = info.param;
  const char* share = setup.share == Share::all_near ? "Near" : setup.share == Share::all_far ? "Far" : "Split";
  const std::string kind = setup.engine == Engine::rays ? scenes::name_of(setup.kind) : "";
  const char* walls = setup.walls == Walls::houses ? "Houses" : "";
  return scene.name + share + name_of(setup.engine) + kind + walls + std::to_string(static_cast<int>(setup.bearing_deg));
}

std::vector<Setup> all_setups() {
  std::vector<Setup> setups;
  for (const double bearing_deg : {0.0, 17.0, 45.0}) {
    for (const Share share : {Share::all_near, Share::all_far, Share::split})
      for (const FarMapKind kind : {FarMapKind::box, FarMapKind::horizon})
        setups.push_back({share, Engine::rays, kind, bearing_deg});
    for (const Share share : {Share::all_near, Share::all_far, Share::split})
      for (const Engine engine : {Engine::automatic, Engine::horizon})
        setups.push_back({share, engine, FarMapKind::horizon, bearing_deg, Walls::houses});
    // The exact engine knows no near and far; how the tiles are cut must not matter to it
    setups.push_back({Share::split, Engine::exact, FarMapKind::box, bearing_deg});
  }
  for (const Share share : {Share::all_near, Share::all_far, Share::split})
    setups.push_back({share, Engine::rays, FarMapKind::horizon, 17.0, Walls::houses});
  return setups;
}

std::vector<Setup> setups_with_bounds() {
  std::vector<Setup> setups = all_setups();
  std::erase_if(setups, [](const Setup& s) { return s.engine == Engine::exact || s.kind != FarMapKind::horizon; });
  return setups;
}

/// With walls that are mere sheets.
std::vector<Setup> setups_with_sheets(Engine engine) {
  std::vector<Setup> setups;
  for (const Share share : {Share::all_near, Share::all_far, Share::split})
    setups.push_back({share, engine, FarMapKind::horizon, 17.0});
  return setups;
}

/// Those that have walls.
std::vector<Scene> scenes_with(bool walls, bool something_overhead) {
  std::vector<Scene> scenes = analytic::all_scenes();
  std::erase_if(scenes, [&](const Scene& s) { return !(walls && s.rise > 0.0) && !(something_overhead && s.is_overhead); });
  return scenes;
}

/// Beside a half plane overhead, the sky below its far end is less than the accuracy of horizons.
std::vector<Scene> scenes_that_need_rays() {
  std::vector<Scene> scenes = scenes_with(false, true);
  std::erase_if(scenes, [](const Scene& scene) { return scene.name == "BesideOverhang"; });
  return scenes;
}

/// All that can be made of houses.
std::vector<Scene> scenes_without_overhang() {
  std::vector<Scene> scenes = analytic::all_scenes();
  std::erase_if(scenes, [](const Scene& s) { return s.is_overhead; });
  return scenes;
}

std::vector<Setup> with_walls_of(std::vector<Setup> setups, Walls walls) {
  std::erase_if(setups, [walls](const Setup& s) { return s.walls != walls; });
  return setups;
}

using testing::Combine;
using testing::ValuesIn;

INSTANTIATE_TEST_SUITE_P(Sheets, AnalyticScene,
                         Combine(ValuesIn(analytic::all_scenes()), ValuesIn(with_walls_of(all_setups(), Walls::sheets))),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Houses, AnalyticScene,
                         Combine(ValuesIn(scenes_without_overhang()), ValuesIn(with_walls_of(all_setups(), Walls::houses))),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Overhangs, AnalyticScene,
                         Combine(ValuesIn(scenes_with(true, true)), ValuesIn(setups_with_sheets(Engine::automatic))),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(GroundedSheets, AnalyticScene,
                         Combine(ValuesIn(scenes_with(true, false)), ValuesIn(setups_with_sheets(Engine::horizon))),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Overhangs, AnalyticBounds,
                         Combine(ValuesIn(scenes_with(false, true)), ValuesIn(setups_with_sheets(Engine::automatic))),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Sheets, AnalyticBounds,
                         Combine(ValuesIn(analytic::all_scenes()), ValuesIn(with_walls_of(setups_with_bounds(), Walls::sheets))),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Houses, AnalyticBounds,
                         Combine(ValuesIn(scenes_without_overhang()),
                                 ValuesIn(with_walls_of(setups_with_bounds(), Walls::houses))),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Overhangs, AnalyticRefusal,
                         Combine(ValuesIn(scenes_that_need_rays()), ValuesIn(setups_with_sheets(Engine::horizon))), name_of_case);

}  // namespace
}  // namespace farlod
