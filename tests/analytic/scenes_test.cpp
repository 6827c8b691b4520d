// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "evaluate/sky_evaluator.hpp"
#include "package/package_error.hpp"
#include "tests/analytic/analytic_scenes.hpp"
#include "tests/analytic/setups.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// Scenes with a known answer go the whole way, from facets to a package and back: with all of their geometry near, all of it in
// the far map, and some of it in each; with walls that are mere sheets and with houses that stand; on all engines, with far maps
// of both kinds; on grids that are turned three ways. Each case is one package, asked in all ways that answer from it. Each pair
// of these values occurs, not the whole product (setups.hpp; setups_test.cpp counts).

namespace farlod {
namespace {

using analytic::Case;
using analytic::eye_m;
using analytic::ground;
using analytic::Scene;
using analytic::Setup;
using analytic::Share;
using analytic::Stage;
using analytic::Walls;
using scenes::SceneBuilder;

constexpr std::size_t rays = 200000, azimuths = 4096;

FarMapSettings maps_of(FarMapKind kind) { return kind == FarMapKind::box ? scenes::box_maps(256, 256) : FarMapSettings{}; }

bool asks_for_horizons(Engine engine) { return engine == Engine::automatic || engine == Engine::horizon; }

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
double allowed_error(const Scene& scene, Engine engine, SkyWeight weight) {
  const double by_rays = allowed_sampling(scene);
  return asks_for_horizons(engine) ? std::max(by_rays, azimuth_error_of(scene, weight)) : by_rays;
}

/// Beside a half plane overhead, the sky below its far end is less than the accuracy of horizons.
bool needs_rays(const Scene& scene) { return scene.is_overhead && scene.name != "BesideOverhang"; }

class AnalyticScene : public testing::TestWithParam<Case> {
 protected:
  void expect_known(Engine engine, SkyWeight weight, double expected) const {
    // What the far map of the kind `horizon` leaves open is traced: its own error is nothing
    const bool retraces = setup_.kind == FarMapKind::horizon;
    const double svf = packed_.evaluate(engine, weight, retraces ? std::optional(0.0) : std::nullopt).estimate;
    double tolerance = allowed_error(scene_, engine, weight);
    if (engine == Engine::rays && setup_.kind == FarMapKind::box && setup_.share != Share::all_near)
      tolerance += box_map_error(packed_.package().box_far_map({0, 0}).shape(), scene_.rise,
                                 weight == SkyWeight::cosine ? steepest_cos : steepest_solid);
    EXPECT_NEAR(svf, expected, tolerance);
  }

  void expect_bounds(Engine engine, SkyWeight weight, double expected) const {
    const auto [estimate, low, high] = packed_.evaluate(engine, weight);
    EXPECT_LE(low, estimate);
    EXPECT_LE(estimate, high);
    EXPECT_LE(low, expected + allowed_error(scene_, engine, weight));
    EXPECT_GE(high, expected - allowed_error(scene_, engine, weight));
    // Only what is far, or overhangs, leaves anything open
    if (setup_.share == Share::all_near && !scene_.is_overhead) {
      EXPECT_EQ(low, high);
    }
  }

  void expect_answer(Engine engine, SkyWeight weight) const {
    if (engine == Engine::horizon && needs_rays(scene_)) {
      EXPECT_THROW((void)packed_.evaluate(engine, weight), PackageUnusable);
      return;
    }
    const double expected = weight == SkyWeight::cosine ? scene_.svf_cos : scene_.svf_solid;
    if (std::isnan(expected)) return;
    expect_known(engine, weight, expected);
    if (setup_.kind == FarMapKind::horizon) expect_bounds(engine, weight, expected);
  }

  const Scene& scene_ = GetParam().scene;
  const analytic::Setup& setup_ = GetParam().setup;
  const PackedScene packed_{scene_, setup_};
};

TEST_P(AnalyticScene, HasItsKnownSkyViewFactor) {
  for (const Engine engine : analytic::engines_for(setup_.kind))
    for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle}) {
      SCOPED_TRACE(std::string(analytic::name_of(engine)) + (weight == SkyWeight::cosine ? ", cosine" : ", solid angle"));
      expect_answer(engine, weight);
    }
}

INSTANTIATE_TEST_SUITE_P(Pairs, AnalyticScene, testing::ValuesIn(analytic::chosen_cases()),
                         [](const auto& chosen) { return analytic::name_of(chosen.param); });

}  // namespace
}  // namespace farlod
